"""The emergency stop as a state: who may lock it, who may release it, and how several nodes agree."""

from __future__ import annotations

import itertools

import pytest
from bot_console_robot.latch import HAND_BACK, RELEASE, SILENCE_NS, STEER, STOP, Latch, Lock, Request
from bot_console_robot.stop_messages import lock_of, request_message, request_of, state_message
from diagnostic_msgs.msg import DiagnosticStatus

ANNA = Request(STOP, "anna", "the arm swings", "a")


def test_it_begins_released_and_the_first_word_locks_it() -> None:
    latch = Latch()
    assert not latch.lock.held
    assert latch.request(ANNA, 0)
    assert latch.lock == Lock(True, "anna", "the arm swings", 1)


def test_who_holds_it_goes_on_to_hold_it_and_anybody_releases() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    assert not latch.request(Request(STOP, "ben", "me too"), 0)
    assert latch.lock.holder == "anna"
    assert latch.request(Request(RELEASE, "ben"), 0)
    assert not latch.lock.held


@pytest.mark.parametrize("verb", ["", "STOP", "halt", "release "])
def test_a_request_that_nobody_understands_is_a_stop(verb: str) -> None:
    latch = Latch()
    assert latch.request(Request(verb, "anna"), 0)
    assert latch.lock.held


def test_a_console_that_holds_the_steering_and_falls_silent_locks_it() -> None:
    latch = Latch()
    steer = Request(STEER, "anna", key="a")
    assert latch.request(steer, 0) and latch.steered_by == "anna"
    assert not latch.request(steer, SILENCE_NS)
    assert not latch.watch(2 * SILENCE_NS)
    assert latch.watch(2 * SILENCE_NS + 1)
    assert latch.lock.held and latch.lock.holder == "anna" and not latch.steered_by


def test_steering_that_is_handed_back_needs_no_heartbeat() -> None:
    latch = Latch()
    latch.request(Request(STEER, "anna", key="a"), 0)
    assert latch.request(Request(HAND_BACK, "anna", key="a"), 1)
    assert not latch.watch(10 * SILENCE_NS) and not latch.lock.held


def test_another_nodes_lock_is_followed_but_not_one_older_than_the_release() -> None:
    here, there = Latch(), Latch()
    there.request(ANNA, 0)
    locked = there.lock
    assert here.follow(locked) and here.lock == locked
    here.request(Request(RELEASE, "anna"), 0)
    assert not here.follow(locked) and not here.lock.held
    assert not there.follow(here.lock) and there.lock.held, "a release is a person's, never another node's"


@pytest.mark.parametrize("order", list(itertools.permutations(range(4))))
def test_two_latches_agree_in_any_order_of_delivery_once_all_has_come(order: tuple[int, ...]) -> None:
    """Both get the same requests in the same order; their states reach each other at any time."""
    here, there = Latch(), Latch()
    verbs = [STOP, RELEASE, STOP, RELEASE]
    told: list[Lock] = []
    for verb in verbs:
        there.request(Request(verb, "anna"), 0)
        told.append(there.lock)
    for verb in verbs:
        here.request(Request(verb, "anna"), 0)
    for number in order:
        here.follow(told[number])
    assert not here.lock.held and not there.lock.held


def test_messages_give_back_what_was_said() -> None:
    assert request_of(request_message(ANNA)) == ANNA
    lock = Lock(True, "anna", "the arm swings", 7)
    assert lock_of(state_message(lock, "simulator", "1", "ben")) == (lock, "1")


def test_a_state_that_cannot_be_read_is_a_lock() -> None:
    assert lock_of(DiagnosticStatus())[0].held
    assert request_of(DiagnosticStatus()).verb == ""
