"""When a frame may be drawn, by a clock that the test steps."""

from __future__ import annotations

import pytest
from bot_console.tui.terminal.frame_pacing import (
    FRAME_INTERVAL_S,
    FRAME_TIMEOUT_S,
    MAX_FRAME_TIMEOUT_S,
    MAX_IN_FLIGHT,
    MERGED_NEWS_S,
    MIN_MERGED_FRAMES,
    SLOW_ANSWER_S,
    UNPACED_AFTER_KEY_S,
    AnswerGate,
)


class Clock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def gate(clock: Clock) -> AnswerGate:
    return AnswerGate(clock)


def draw(gate: AnswerGate, size: int = 100) -> None:
    gate.asked(size)
    gate.drawn()


def test_first_frame_is_sent_at_once(gate: AnswerGate) -> None:
    assert gate.wait() == 0


def test_frames_are_paced(gate: AnswerGate, clock: Clock) -> None:
    draw(gate)
    gate.answered()
    assert gate.wait() == pytest.approx(FRAME_INTERVAL_S)
    clock.now += FRAME_INTERVAL_S
    assert gate.wait() == 0


def test_effect_of_a_key_is_shown_at_once(gate: AnswerGate, clock: Clock) -> None:
    draw(gate)
    gate.answered()
    gate.pressed()
    assert gate.wait() == 0
    clock.now += UNPACED_AFTER_KEY_S + 0.01
    draw(gate)
    assert gate.wait() == pytest.approx(FRAME_INTERVAL_S)


def test_no_more_than_two_frames_wait_for_an_answer(gate: AnswerGate, clock: Clock) -> None:
    draw(gate)
    gate.answered()
    for _ in range(MAX_IN_FLIGHT):
        draw(gate)
        clock.now += FRAME_INTERVAL_S
    gate.pressed()
    assert gate.wait() > 0, "not even for a key"
    gate.answered()
    assert gate.wait() == 0


def test_a_slow_answer_leaves_one_frame_in_flight(gate: AnswerGate, clock: Clock) -> None:
    draw(gate)
    clock.now += SLOW_ANSWER_S + 0.1
    gate.answered()
    draw(gate)
    clock.now += FRAME_INTERVAL_S
    assert gate.wait() > 0
    gate.answered()
    for _ in range(MAX_IN_FLIGHT - 1):
        draw(gate)
        clock.now += FRAME_INTERVAL_S
    assert gate.wait() == 0, "the answer was quick again"


def test_terminal_that_never_answers_is_not_awaited(gate: AnswerGate, clock: Clock) -> None:
    for _ in range(10):
        draw(gate)
        clock.now += FRAME_INTERVAL_S
        assert gate.wait() == 0


def test_a_stalled_terminal_gets_ever_fewer_frames(gate: AnswerGate, clock: Clock) -> None:
    draw(gate)
    gate.answered()
    waits: list[float] = []
    for _ in range(12):
        draw(gate, 0)
        draw(gate, 0)
        waits.append(gate.wait())
        clock.now += 2 * MAX_FRAME_TIMEOUT_S
    assert waits[0] == pytest.approx(FRAME_TIMEOUT_S)
    assert waits == sorted(waits)
    assert waits[-1] == pytest.approx(MAX_FRAME_TIMEOUT_S)
    gate.answered()
    draw(gate, 0)
    draw(gate, 0)
    assert gate.wait() == pytest.approx(FRAME_TIMEOUT_S), "it answers again"


def test_merged_frames_are_reported_only_while_they_are_many_and_recent(gate: AnswerGate, clock: Clock) -> None:
    draw(gate)
    gate.answered()
    gate.merged()
    assert gate.held_back == 0, "pacing alone does not count as holding back"
    for _ in range(MAX_IN_FLIGHT):
        draw(gate)
    for _ in range(MIN_MERGED_FRAMES - 1):
        gate.merged()
    assert gate.held_back == 0
    gate.merged()
    assert gate.held_back == MIN_MERGED_FRAMES
    clock.now += MERGED_NEWS_S + 0.1
    assert gate.held_back == 0


def test_only_a_terminal_that_has_answered_before_has_pending_answers(gate: AnswerGate) -> None:
    draw(gate)
    assert not gate.has_unanswered, "it may never answer"
    gate.answered()
    assert not gate.has_unanswered
    draw(gate)
    assert gate.has_unanswered
