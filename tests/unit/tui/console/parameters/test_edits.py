"""Edits until they are done: sent, refused, late, staged and compared, without any widget."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from typing import Any

import pytest
from bot_console.tui.console.model import ChangeSource, ParameterInfo, SetOutcome
from bot_console.tui.console.parameters.edits import BURST_S, ParameterEdits
from bot_console.tui.console.parameters.pending_sets import ANSWER_DELAY_S
from fakes.console import FakeConsole
from samples import live

NAVIGATOR = "/robot_navigator"
SPEED, RATE, MARGIN = ((NAVIGATOR, name) for name in ("max_speed", "turn_rate", "safety_distance"))


class Bench:
    """The edits of a console whose drawing thread is this one."""

    def __init__(self) -> None:
        self.console: FakeConsole = live()[0]
        self.now = 100.0
        self.drawn = 0
        self.failures: list[tuple[str, int]] = []
        self.edits = ParameterEdits(
            self.console.parameters,
            lambda: self.console.current.parameters,
            lambda call, *given: call(*given),
            self._draw,
            lambda error, outcomes: self.failures.append((error, len(outcomes))),
            lambda: self.now,
        )

    def _draw(self) -> None:
        self.drawn += 1

    def parameter(self, key: tuple[str, str]) -> ParameterInfo:
        found = self.console.current.parameters[key[0]].get(key[1])
        assert found is not None
        return found

    def value(self, key: tuple[str, str]) -> object:
        return self.parameter(key).value

    def set(self, key: tuple[str, str], value: Any) -> None:
        self.edits.set(self.parameter(key), value)

    def step(self, key: tuple[str, str], value: Any, after_s: float = 0.1) -> None:
        self.now += after_s
        self.edits.step(self.parameter(key), value)

    def undo(self, key: tuple[str, str]) -> object:
        """The value after one undo."""
        self.console.parameters.undo()
        return self.value(key)

    def hold_answers(self, name: str) -> Future[tuple[SetOutcome, ...]]:
        """Let a method of the port answer when the test sets the returned future."""
        answer: Future[tuple[SetOutcome, ...]] = Future()
        setattr(self.console.parameters, name, lambda *given, **named: answer)
        return answer


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_refusal_stays_until_the_value_is_accepted_changed_or_dismissed(bench: Bench) -> None:
    bench.set(SPEED, 99.0)
    assert bench.edits.refused[SPEED].value == 99.0 and bench.drawn == 1
    bench.set(SPEED, 0.5)
    assert bench.edits.refused == {} and bench.value(SPEED) == 0.5
    bench.set(SPEED, 99.0)
    bench.edits.value_changed(SPEED)
    assert bench.edits.refused == {}
    bench.set(SPEED, 99.0)
    assert bench.edits.dismiss(SPEED) and not bench.edits.dismiss(SPEED) and bench.edits.refused == {}


def test_sent_value_is_late_only_after_some_time_and_until_it_is_answered(bench: Bench) -> None:
    answer = bench.hold_answers("set")
    bench.set(SPEED, 0.5)
    assert not bench.edits.poll()
    bench.now += ANSWER_DELAY_S
    assert bench.edits.poll() and bench.edits.late == {SPEED: 0.5} and not bench.edits.poll()
    answer.set_result((SetOutcome(*SPEED, 0.5, True),))
    assert bench.edits.poll() and bench.edits.late == {}


def test_error_of_a_request_is_reported_and_refuses_no_value(bench: Bench) -> None:
    bench.hold_answers("set").set_exception(ValueError("no such thing"))
    bench.set(SPEED, 0.5)
    assert bench.failures == [("no such thing", 0)] and bench.edits.refused == {}


def test_staged_values_are_sent_together_and_forgotten_once_accepted(bench: Bench) -> None:
    bench.edits.stage()
    bench.set(SPEED, 0.5)
    bench.set(RATE, 0.7)
    assert bench.edits.now(bench.parameter(SPEED)) == 0.5 and bench.value(SPEED) != 0.5
    bench.edits.apply(dict(bench.edits.staging.marked))
    assert (bench.value(SPEED), bench.value(RATE)) == (0.5, 0.7)
    assert bench.edits.staging.marked == {} and not bench.edits.staging.marking


def test_refused_set_stays_staged_and_is_reported(bench: Bench) -> None:
    before = bench.value(RATE)
    bench.edits.stage()
    bench.set(SPEED, 99.0)
    bench.set(RATE, 0.7)
    bench.edits.apply(dict(bench.edits.staging.marked))
    assert bench.value(RATE) == before and bench.failures == [("", 2)]
    assert bench.edits.staging.marked == {SPEED: 99.0, RATE: 0.7} and bench.edits.staging.marking


def test_value_staged_while_a_set_is_answered_stays_staged(bench: Bench) -> None:
    answer = bench.hold_answers("set_all")
    bench.edits.stage()
    bench.set(SPEED, 0.5)
    bench.edits.apply(dict(bench.edits.staging.marked))
    bench.edits.stage()
    bench.set(SPEED, 0.6)
    answer.set_result((SetOutcome(*SPEED, 0.5, True),))
    assert bench.edits.staging.marked == {SPEED: 0.6} and bench.edits.staging.marking


def test_two_sets_are_swapped(bench: Bench) -> None:
    first = bench.value(SPEED)
    bench.edits.begin_sets({SPEED: 0.5})
    assert bench.value(SPEED) == 0.5 and bench.edits.staging.live == 1
    bench.edits.swap()
    assert bench.value(SPEED) == first and bench.edits.staging.live == 0


def test_values_that_differ_from_the_start_or_are_in_no_file_are_known(bench: Bench) -> None:
    first = bench.value(MARGIN)
    bench.edits.observe(bench.console.current.journal)
    assert MARGIN not in bench.edits.moved and MARGIN not in bench.edits.unsaved
    bench.set(MARGIN, 0.5)
    assert bench.edits.observe(bench.console.current.journal)
    assert MARGIN in bench.edits.moved and MARGIN in bench.edits.unsaved
    assert not bench.edits.observe(bench.console.current.journal)
    bench.console.take(NAVIGATOR, {"safety_distance": first}, ChangeSource.OTHER)
    assert bench.edits.observe(bench.console.current.journal) and MARGIN not in bench.edits.moved


def test_risks_name_what_makes_the_robot_less_safe(bench: Bench) -> None:
    values: Mapping[tuple[str, str], Any] = {SPEED: 2.0, RATE: 0.7, MARGIN: 0.4}
    found = {each.name: (value, why) for each, value, why in bench.edits.risks(values)}
    assert found == {
        "max_speed": (2.0, "raises a safety limit"),
        "safety_distance": (0.4, "lowers a safety margin"),
    }


def test_only_the_newest_of_values_set_before_an_answer_follows(bench: Bench) -> None:
    answer = bench.hold_answers("set")
    bench.set(SPEED, 0.5)
    sent: list[object] = []
    bench.console.parameters.set = lambda node, values, source, **how: sent.append(dict(values)) or Future()
    bench.set(SPEED, 0.6)
    bench.set(SPEED, 0.7)
    assert bench.edits.now(bench.parameter(SPEED)) == 0.7 and sent == []
    answer.set_result((SetOutcome(*SPEED, 0.5, True),))
    assert sent == [{"max_speed": 0.7}]


def test_a_burst_of_steps_is_undone_as_a_whole(bench: Bench) -> None:
    start = bench.value(SPEED)
    bench.set(SPEED, 0.5)
    for value in (0.51, 0.52, 0.53):
        bench.step(SPEED, value)
    changes = [(each.old, each.new) for each in bench.console.parameters.changes() if each.name == SPEED[1]]
    assert changes[-3:] == [(0.5, 0.51), (0.51, 0.52), (0.52, 0.53)]
    assert bench.undo(SPEED) == 0.5
    assert bench.undo(SPEED) == start
    bench.console.parameters.redo()
    bench.console.parameters.redo()
    assert bench.value(SPEED) == 0.53


@pytest.mark.parametrize("between", ["time", "edit", "other", "elsewhere", "undo", "refusal"])
def test_a_burst_of_steps_ends_with_a_pause_and_with_any_other_change(bench: Bench, between: str) -> None:
    bench.set(SPEED, 0.5)
    bench.step(SPEED, 0.6)
    before: object = 0.6
    if between == "edit":
        bench.set(SPEED, 0.7)
        before = 0.7
    elif between == "other":
        bench.step(RATE, 1.0)
    elif between == "elsewhere":
        bench.console.take(SPEED[0], {SPEED[1]: 0.9}, ChangeSource.OTHER)
        before = 0.9
    elif between == "undo":
        assert bench.undo(SPEED) == 0.5
        before = 0.5
    elif between == "refusal":
        bench.step(SPEED, 99.0)
    bench.step(SPEED, 0.8, BURST_S if between == "time" else 0.1)
    assert bench.undo(SPEED) == before


def test_steps_that_follow_an_answer_belong_to_the_burst_of_the_one_before(bench: Bench) -> None:
    answer = bench.hold_answers("set")
    sent: list[bool] = []
    bench.step(SPEED, 0.6)
    bench.console.parameters.set = lambda node, values, source, continues: sent.append(continues) or Future()
    bench.step(SPEED, 0.7)
    bench.step(SPEED, 0.8)
    answer.set_result((SetOutcome(*SPEED, 0.6, True),))
    assert sent == [True]


def test_escape_dismisses_a_refusal_and_keeps_staged_values(bench: Bench) -> None:
    bench.edits.stage()
    bench.set(SPEED, 0.5)
    assert not bench.edits.dismiss(SPEED) and bench.edits.staging.marked == {SPEED: 0.5}
    bench.edits.unstage(SPEED)
    assert bench.edits.staging.marked == {}
