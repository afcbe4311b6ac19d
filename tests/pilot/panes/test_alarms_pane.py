"""Alarms: added, announced once for each crossing, kept for the next start, and silent about missing topics."""

from __future__ import annotations

import pytest
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.panes.alarms.pane import AlarmsPane, split_name
from bot_console.tui.panes.alarms.rows import AlarmRows
from fleet import fleet
from piloting import Session, run
from samples import live

SPEED = "/odom/twist.twist.linear.x"


async def feed_speeds(session: Session, *values: float) -> None:
    """Let new values of the speed arrive, and a second pass."""
    times, known = session.console.series[SPEED]
    for value in values:
        session.console.now += 0.1
        times.append(session.console.now)
        known.append(value)
    pane = session.pane(AlarmsPane)
    pane.clock.now += 1.0
    pane.tick()
    await session.settle()


def alarm_notifications(session: Session) -> int:
    return sum(each.title == "Alarm" for each in session.app._notifications)


async def add(session: Session, text: str) -> None:
    await session.press("a")
    await session.paste(text)
    await session.press("enter")


def test_alarm_is_announced_once_per_crossing_even_while_hidden() -> None:
    async def play(session: Session) -> None:
        await session.press("B")
        await add(session, f"too fast: {SPEED} > 2")
        await feed_speeds(session, 1.0)
        assert alarm_notifications(session) == 0 and "○ quiet" in session.text()
        await session.press("1")
        await feed_speeds(session, 2.5, 2.6)
        assert alarm_notifications(session) == 1 and "too fast: 2.5" in session.text()
        await feed_speeds(session, 2.7)
        assert alarm_notifications(session) == 1, "the condition still holds"
        assert "⚠ too fast" in session.lines()[-2], "the status bar names it in every pane"
        await session.press("B")
        assert "✗ active" in session.text() and "1 time" in session.text() and "1 of 1 active" in session.text()
        await feed_speeds(session, 1.0, 3.0, 1.0)
        assert alarm_notifications(session) == 1, "the first notification is still visible"
        session.pane(AlarmsPane).clock.now += 8.0
        await feed_speeds(session, 1.0, 4.0, 1.0)
        assert "(2 times)" in session.text(), "it is reported together with the previous one"
        assert alarm_notifications(session) == 2 and "○ quiet" in session.text() and "3 times" in session.text()
        assert "⚠" not in session.lines()[-2]

    run(live(), play, (120, 30))


def test_bell_rings_only_for_alarms_with_bell(monkeypatch) -> None:
    async def play(session: Session) -> None:
        rung = []
        monkeypatch.setattr(session.app, "bell", lambda: rung.append(1))
        await session.press("B")
        await add(session, f"{SPEED} > 2")
        await feed_speeds(session, 3.0)
        assert rung == []
        await session.press("b")
        await feed_speeds(session, 1.0, 3.0)
        assert rung == [1] and session.pane(AlarmRows).current.bell

    run(live(), play)


def test_alarms_are_stored_edited_and_deleted() -> None:
    async def play(session: Session) -> None:
        await session.press("B")
        await add(session, "fast: 1 < 2")
        assert "name a field" in session.text()
        await session.press("escape")
        await add(session, f"fast: {SPEED} > 2")
        assert session.app.state_store.get("alarms") == [{"name": "fast", "condition": f"{SPEED} > 2"}]
        await session.press("e", "backspace")
        await session.type("3")
        await session.press("enter")
        assert session.app.state_store.get("alarms") == [{"name": "fast", "condition": f"{SPEED} > 3"}]
        await session.press("d")
        assert session.app.state_store.get("alarms") == [] and ("unwatch", SPEED) in session.console.asked

    run(live(), play)


@pytest.mark.slow
def test_invalid_condition_is_rejected_and_missing_topic_is_awaited() -> None:
    async def play(session: Session) -> None:
        await session.press("B")
        await add(session, "fast: 1 < 2")
        assert "name a field" in session.text()
        await session.press("escape")
        await add(session, "low: /battery/percentage < 0.2")
        await feed_speeds(session)
        assert "? unknown" in session.text() and "there is no topic /battery" in session.text()
        session.console.series["/battery/percentage"] = ([1.0], [0.1])
        await feed_speeds(session)
        await feed_speeds(session)
        assert "✗ active" in session.text() and alarm_notifications(session) == 1

    run(live(), play, (120, 30))


@pytest.mark.slow
def test_click_selects_and_edits_an_alarm() -> None:
    async def play(session: Session) -> None:
        await session.press("B")
        for name in ("one", "two"):
            await add(session, f"{name}: {SPEED} > 2")
        await session.pilot.click(AlarmRows, offset=(20, 0))
        await session.settle()
        assert session.pane(AlarmRows).current.name == "one"
        await session.pilot.click(AlarmRows, offset=(20, 0))
        await session.settle()
        assert "one: /odom" in session.text().splitlines()[-4]

    run(live(), play, (120, 30))


def test_name_precedes_colon_and_blank() -> None:
    assert split_name("low battery:  /a/b  < 1") == ("low battery", "/a/b < 1")
    assert split_name("/node:speed < 1") == ("/node:speed < 1", "/node:speed < 1")


def test_alarms_are_suggested_with_live_values_and_enter_watches_one() -> None:
    system = live()
    system[0].series["rate(/scan)"] = ([1.0], [9.8])
    system[0].series["/scan/ranges.min()"] = ([1.0], [0.85])

    async def play(session: Session) -> None:
        await session.press("B")
        await feed_speeds(session, 0.5)
        row = next(line for line in session.lines() if "close to something" in line)
        assert "min(/scan/ranges) < 0.3" in row and "now 0.85" in row
        assert "enter Watch" in session.lines()[-1] and "Delete" not in session.lines()[-1]
        assert "Nothing is watched yet" in session.text() and session.app.state_store.get("alarms") is None
        session.console.series["/scan/ranges.min()"] = ([1.0, 2.0], [0.85, 0.7])
        session.console.change(drive=DriveInfo())
        await session.settle()
        assert "now 0.85" in session.text(), "not with each change of the system, which would be too fast to read"
        await feed_speeds(session, 0.5)
        assert "now 0.7" in session.text()
        while session.pane(AlarmRows).current.name != "no scan":
            await session.press("down")
        await session.press("enter")
        assert session.app.state_store.get("alarms") == [{"name": "no scan", "condition": "rate(/scan) < 1"}]
        await feed_speeds(session, 0.5)
        assert "enter Edit  d Delete  b Bell" in session.lines()[-1]
        assert "○ quiet" in session.text() and "close to something" not in session.text()
        session.console.series["rate(/scan)"] = ([1.0, 2.0], [9.8, 0.0])
        await feed_speeds(session, 0.5)
        assert "✗ active" in session.text()
        assert ("unwatch", "/scan/ranges.min()") in session.console.asked, (
            "topics that are not suggested are not received"
        )

    run(system, play, (100, 30))


@pytest.mark.slow
def test_suggestions_are_not_cut_where_they_differ_in_a_small_terminal() -> None:
    async def play(session: Session) -> None:
        await session.press("B")
        row = next(line for line in session.lines() if "robot2" in line and "stands still" in line)
        assert ") < 0.01" in row
        assert "no value yet" in session.text() and "no value …" not in session.text()

    run(fleet(), play)


def test_suggested_topics_are_not_received_while_the_pane_is_hidden() -> None:
    system = live()
    system[0].series["rate(/scan)"] = ([1.0], [9.8])

    async def play(session: Session) -> None:
        await feed_speeds(session, 0.5)
        assert ("watch", "rate(/scan)") not in session.console.asked
        await session.press("B")
        await feed_speeds(session, 0.5)
        assert ("watch", "rate(/scan)") in session.console.asked
        await session.press("1")
        await feed_speeds(session, 0.5)
        assert ("unwatch", "rate(/scan)") in session.console.asked

    run(system, play)
