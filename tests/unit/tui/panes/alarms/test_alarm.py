"""Alarms: each crossing counts once, even a short one, and unknown values are shown as unknown."""

from __future__ import annotations

from bot_console.tui.panes.alarms.alarm import Alarm, AlarmText, alarm_texts_in
from fakes.console import FakeConsole

A, B = "/a/x", "/b/x"


def console(**series: tuple[list[float], list[float]]) -> FakeConsole:
    made = FakeConsole()
    for name, (times, values) in series.items():
        made.series[f"/{name}/x"] = (times, values)
        assert made.watch(f"/{name}/x").ok
    return made


def test_every_crossing_counts_once_even_if_brief() -> None:
    robot = console(a=([1.0, 2.0, 3.0], [0.0, 2.0, 0.0]))
    alarm = Alarm.of(AlarmText("fast", "/a/x > 1"))
    assert alarm.poll(robot) == [2.0] and (alarm.holds, alarm.times) == (False, 1)
    assert alarm.poll(robot) == [], "nothing is new"
    for time, value in ((4.0, 3.0), (5.0, 4.0)):
        robot.series[A][0].append(time)
        robot.series[A][1].append(value)
    assert alarm.poll(robot) == [3.0] and (alarm.holds, alarm.times, alarm.since) == (True, 2, 4.0)


def test_samples_of_several_paths_are_processed_in_order_of_arrival() -> None:
    robot = console(a=([1.0, 3.0], [5.0, 0.0]), b=([2.0, 4.0], [0.0, 5.0]))
    alarm = Alarm.of(AlarmText("both", "/a/x > 1 and /b/x > 1"))
    assert alarm.poll(robot) == [] and alarm.holds is False, "the two never held at the same time"


def test_alarm_state_is_unknown_without_a_value() -> None:
    robot = console(a=([1.0], [5.0]))
    alarm = Alarm.of(AlarmText("both", "/a/x > 1 and /b/x > 1"))
    assert alarm.poll(robot) == [] and alarm.holds is None
    divided = Alarm.of(AlarmText("ratio", "1 / (/a/x - 5) > 1"))
    assert divided.poll(robot) == [] and divided.holds is None and "zero" in divided.problem


def test_alarms_are_stored_as_plain_data_and_invalid_ones_ignored() -> None:
    alarm = AlarmText("low", "/a/x < 1", bell=True)
    assert alarm_texts_in([alarm.data, {"name": "bad", "condition": "1 <"}, 7, {"name": 3}]) == [alarm]
    assert alarm_texts_in("nothing") == []
