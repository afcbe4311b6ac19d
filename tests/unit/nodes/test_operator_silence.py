"""A lock locks itself when whoever holds the steering falls silent."""

from bot_console_robot.safety.latch import HAND_BACK, STEER, Latch, Request
from bot_console_robot.safety.operator_silence import SILENCE_TIMEOUT_NS


def test_silence_of_a_steering_console_locks_the_robot() -> None:
    latch = Latch()
    steer = Request(STEER, "anna", key="a")
    assert latch.request(steer, 0) and latch.steered_by == "anna"
    assert not latch.request(steer, SILENCE_TIMEOUT_NS)
    assert not latch.watch(2 * SILENCE_TIMEOUT_NS)
    assert latch.watch(2 * SILENCE_TIMEOUT_NS + 1)
    assert latch.lock.held and latch.lock.holder == "anna" and not latch.steered_by


def test_two_locks_make_the_same_stop_for_one_silence_and_another_for_the_next() -> None:
    here, there = Latch(), Latch()
    steer = Request(STEER, "anna", key="a", id="s1")
    for latch in (here, there):
        latch.request(steer, 0)
        latch.watch(SILENCE_TIMEOUT_NS + 1)
    assert here.lock == there.lock and here.lock.ids == {"s1"}
    here.release(["s1"], "ben")
    here.request(steer, 0)
    here.watch(SILENCE_TIMEOUT_NS + 1)
    assert here.lock.held, "a recorded steering request must not end the silence"


def test_returned_steering_needs_no_heartbeat() -> None:
    latch = Latch()
    latch.request(Request(STEER, "anna", key="a"), 0)
    assert latch.request(Request(HAND_BACK, "anna", key="a"), 1)
    assert not latch.watch(10 * SILENCE_TIMEOUT_NS) and not latch.lock.held
