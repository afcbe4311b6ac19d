"""The emergency stop as a state: who may lock it, who may release it, and how several nodes agree."""

from __future__ import annotations

import itertools

import pytest
from bot_console_robot.safety.latch import (
    CROWD,
    HAND_BACK,
    MOST,
    RELEASE,
    SILENCE_NS,
    STEER,
    STOP,
    Latch,
    Lock,
    Request,
    Stop,
)
from bot_console_robot.safety.stop_messages import lock_of, request_message, request_of, state_message
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

ANNA = Request(STOP, "anna", "the arm swings", "a")


def test_it_begins_released_and_the_first_word_locks_it() -> None:
    latch = Latch()
    assert not latch.lock.held
    assert latch.request(ANNA, 0)
    assert latch.lock == Lock((Stop("a", "anna", "the arm swings", 1),), 1)


def test_it_is_held_until_the_last_of_those_who_stopped_it_has_released_it() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    assert latch.request(Request(STOP, "ben", "me too", "b"), 0)
    assert not latch.request(Request(STOP, "ben", "again", "b"), 0)
    assert latch.lock.holder == "anna"
    assert latch.request(Request(RELEASE, "anna", key="a"), 0)
    assert (latch.lock.held, latch.lock.holder, latch.lock.reason) == (True, "ben", "me too")
    assert latch.request(Request(RELEASE, "ben", key="b"), 0) and not latch.lock.held


def test_anothers_stop_is_released_only_by_naming_it() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    assert not latch.request(Request(RELEASE, "ben", key="b"), 0) and latch.lock.held
    assert not latch.request(Request(RELEASE, "ben", key="b", of=("c",)), 0) and latch.lock.held
    assert latch.request(Request(RELEASE, "ben", key="b", of=("a",)), 0) and not latch.lock.held


def test_what_a_node_has_stopped_by_itself_anybody_releases() -> None:
    latch = Latch()
    assert latch.stop("simulator", "the safety monitor has gone")
    assert latch.request(Request(RELEASE, "ben", key="b"), 0) and not latch.lock.held


def test_stops_beyond_all_measure_are_one_and_are_released_by_name() -> None:
    latch = Latch()
    for number in range(10_000):
        latch.request(Request(STOP, f"n{number}", key=str(number)), 0)
        latch.request(Request(STEER, f"n{number}", key=str(number)), 0)
    assert len(latch.lock.stops) == MOST + 1 and len(latch.steered_by.split(", ")) == MOST + 1
    latch.release([each.key for each in latch.lock.stops if each.key != CROWD])
    assert latch.lock.held
    assert latch.release([CROWD]) and not latch.lock.held


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
    here.request(Request(RELEASE, "anna", key="a"), 0)
    assert not here.follow(locked) and not here.lock.held
    assert not there.follow(here.lock) and there.lock.held, "a release is a person's, never another node's"


@pytest.mark.parametrize("order", list(itertools.permutations(range(4))))
def test_two_latches_agree_in_any_order_of_delivery_once_all_has_come(order: tuple[int, ...]) -> None:
    """Both get the same requests in the same order; their states reach each other at any time."""
    here, there = Latch(), Latch()
    verbs = [STOP, RELEASE, STOP, RELEASE]
    told: list[Lock] = []
    for verb in verbs:
        there.request(Request(verb, "anna", key="a"), 0)
        told.append(there.lock)
    for verb in verbs:
        here.request(Request(verb, "anna", key="a"), 0)
    for number in order:
        here.follow(told[number])
    assert not here.lock.held and not there.lock.held


def test_a_stop_that_only_one_of_two_has_heard_reaches_the_other_beside_those_it_has() -> None:
    here, there = Latch(), Latch()
    here.request(ANNA, 0)
    there.stop("ben", "my foot", "b")
    assert here.follow(there.lock) and there.follow(here.lock)
    assert {each.key for each in here.lock.stops} == {each.key for each in there.lock.stops} == {"a", "b"}
    here.release(["a"])
    assert not there.follow(here.lock) and [each.key for each in here.lock.stops] == ["b"]


def test_messages_give_back_what_was_said() -> None:
    assert request_of(request_message(ANNA)) == ANNA
    release = Request(RELEASE, "ben", "", "b", ("a", "node"))
    assert request_of(request_message(release)) == release
    lock = Lock((Stop("a", "anna", "the arm swings", 3), Stop("b", "ben", "", 7)), 7)
    assert lock_of(state_message(lock, "simulator", "1", "ben")) == (lock, "1")


def test_a_state_that_cannot_be_read_is_a_lock() -> None:
    assert lock_of(DiagnosticStatus())[0].held
    assert request_of(DiagnosticStatus()).verb == ""


@pytest.mark.parametrize("text", ["", "[", "{}", "[[]]", "[1, 2]", "[[1, 2, 3, 4], null]", '["*"]', "[" * 100_000])
def test_stops_that_cannot_be_read_are_one_and_a_release_of_them_is_the_askers_own(text: str) -> None:
    state = DiagnosticStatus(values=[KeyValue(key="locked", value="true"), KeyValue(key="stops", value=text)])
    assert len(lock_of(state)[0].stops) == 1
    values = [KeyValue(key="request", value="release"), KeyValue(key="of", value=text)]
    asked = request_of(DiagnosticStatus(hardware_id="b", values=values))
    assert asked.of == (("*",) if "*" in text else ("b",))
