"""The emergency stop as a state: who may lock it, who may release it, and how several nodes agree."""

from __future__ import annotations

import itertools

import pytest
from bot_console_robot.safety.latch import RELEASE, STEER, STOP, Latch, Request
from bot_console_robot.safety.lock import MAX_RELEASES, MAX_STOPS, NODE, OTHERS, Lock, Release, Stop
from bot_console_robot.safety.stop_messages import State, parse_request, parse_state, request_message, state_message
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

ANNA = Request(STOP, "anna", "the arm swings", "a", "a1")
BEN = Request(STOP, "ben", "me too", "b", "b1")


def release(latch: Latch, *ids: str, by: str = "ben") -> bool:
    """Send a release that quotes the lock's current challenge."""
    return latch.request(Request(RELEASE, by, key=by, ids=ids, challenges=(latch.challenge,)), 0)


def test_latch_starts_released_and_first_request_locks_it() -> None:
    latch = Latch()
    assert not latch.lock.held
    assert latch.request(ANNA, 0)
    assert latch.lock == Lock((Stop("a1", "a", "anna", "the arm swings", 1),), 1)


def test_latch_is_held_until_last_requester_releases() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    assert latch.request(BEN, 0)
    assert not latch.request(Request(STOP, "ben", "again", "b", "b1"), 0)
    assert latch.lock.holder == "anna"
    assert release(latch, "a1", by="anna")
    assert (latch.lock.held, latch.lock.holder, latch.lock.reason) == (True, "ben", "me too")
    assert release(latch, "b1") and not latch.lock.held


def test_release_covers_only_the_stops_it_names() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    release(latch, "c1")
    release(latch)
    assert latch.lock.held
    assert release(latch, "a1") and not latch.lock.held


def test_released_stop_never_returns_from_a_late_copy() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    held = latch.lock
    release(latch, "a1")
    assert not latch.request(ANNA, 0) and not latch.follow(held) and not latch.lock.held
    assert latch.request(Request(STOP, "anna", "again", "a", "a2"), 0) and latch.lock.held


def test_release_that_overtakes_its_stop_counts() -> None:
    latch = Latch()
    release(latch, "a1")
    assert not latch.request(ANNA, 0) and not latch.lock.held


def test_release_must_quote_the_challenge_of_its_stops() -> None:
    latch = Latch()
    latch.request(ANNA, 0)
    recorded = Request(RELEASE, "ben", key="b", ids=("a1", "b1"), challenges=(latch.challenge, "another"))
    latch.request(BEN, 0)
    assert "current challenge" in latch.refusal(recorded)
    assert not latch.request(recorded, 0) and len(latch.lock.stops) == 2
    assert not latch.request(Request(RELEASE, "ben", key="b", ids=("a1", "b1")), 0)
    assert len(latch.lock.stops) == 2
    assert release(latch, "a1", "b1") and not latch.lock.held


def test_no_two_states_of_a_lock_have_the_same_challenge() -> None:
    latch, seen = Latch(), []
    for number in range(3):
        seen.append(latch.challenge)
        latch.request(Request(STOP, "anna", key="a", id=str(number)), 0)
        seen.append(latch.challenge)
        release(latch, str(number))
    assert len(set(seen)) == 6 and Latch().challenge not in seen


def test_older_console_can_stop_and_release_only_its_own_stops() -> None:
    """Its stops have no ids and its releases no challenges, so a copy cannot be distinguished from the original."""
    latch = Latch()
    old = Request(STOP, "old", "now", "o")
    for _ in range(2):
        assert latch.request(old, 0) and not latch.request(old, 0)
        assert latch.request(Request(RELEASE, "old", key="o", of=("o",)), 0) and not latch.lock.held
    latch.request(ANNA, 0)
    latch.request(old, 0)
    latch.stop("simulator", "the safety monitor has gone")
    everything = Request(RELEASE, "other", key="x", of=("a", "a1", "o", NODE))
    assert "no challenge" in latch.refusal(everything) and not latch.request(everything, 0)
    assert latch.request(Request(RELEASE, "old", key="o", of=("o", "a", NODE)), 0)
    assert [each.key for each in latch.lock.stops] == ["a", NODE]


def test_stops_beyond_the_limit_are_merged_and_released_by_one_id() -> None:
    latch = Latch()
    for number in range(10_000):
        latch.request(Request(STOP, f"n{number}", key=str(number), id=str(number)), 0)
        latch.request(Request(STEER, f"n{number}", key=str(number)), 0)
    assert len(latch.lock.stops) == MAX_STOPS + 1 and len(latch.steered_by.split(", ")) == MAX_STOPS + 1
    release(latch, *(each.id for each in latch.lock.stops if each.key != OTHERS))
    assert latch.lock.held
    assert release(latch, *latch.lock.ids) and not latch.lock.held


def test_only_the_latest_releases_are_remembered() -> None:
    latch = Latch()
    for number in range(3 * MAX_RELEASES):
        release(latch, str(number))
    assert [each.id for each in latch.lock.released] == [str(n) for n in range(2 * MAX_RELEASES, 3 * MAX_RELEASES)]


@pytest.mark.parametrize("verb", ["", "STOP", "halt", "release "])
def test_request_with_unknown_verb_is_a_stop(verb: str) -> None:
    latch = Latch()
    assert latch.request(Request(verb, "anna"), 0)
    assert latch.lock.held


@pytest.mark.parametrize("order", list(itertools.permutations(range(4))))
def test_two_latches_agree_in_any_order_of_delivery(order: tuple[int, ...]) -> None:
    """One receives all requests, the other only its states, at any time."""
    here, there = Latch(), Latch()
    states: list[Lock] = []
    for id in ("a1", "a2"):
        there.request(Request(STOP, "anna", key="a", id=id), 0)
        states.append(there.lock)
        release(there, id)
        states.append(there.lock)
    for number in order:
        here.follow(states[number])
    assert not here.lock.held and here.lock.released == there.lock.released


def test_stop_and_release_known_to_one_lock_reach_the_other() -> None:
    here, there = Latch(), Latch()
    here.request(ANNA, 0)
    there.request(BEN, 0)
    assert here.follow(there.lock) and there.follow(here.lock)
    assert here.lock.ids == there.lock.ids == {"a1", "b1"}
    release(here, "a1")
    assert there.follow(here.lock) and there.lock.ids == {"b1"}
    assert there.lock.released == (Release("a1", "ben", 2),)


def test_restarted_lock_does_not_bring_back_released_stops() -> None:
    here, there = Latch(), Latch()
    here.request(ANNA, 0)
    there.follow(here.lock)
    release(here, "a1")
    again = Latch()
    again.follow(there.lock)  # It had not received the release.
    assert again.lock.held
    assert not here.follow(again.lock) and not here.lock.held
    assert again.follow(here.lock) and not again.lock.held


def test_messages_survive_a_round_trip() -> None:
    assert parse_request(request_message(ANNA)) == ANNA
    asked = Request(RELEASE, "ben", "", "b", ids=("a1", "b1"), challenges=("c1", "c2"), of=("a", "b"))
    assert parse_request(request_message(asked)) == asked
    passing = Request(STOP, "anna", "", "a", "a2", kept=False)
    assert parse_request(request_message(passing)) == passing
    lock = Lock((Stop("a1", "a", "anna", "the arm swings", 3), Stop("b1", "b", "ben", "", 7, kept=False)), 7)
    state = State(Lock(lock.stops, 7, (Release("c1", "carla", 5),)), "1", "a challenge", "ben")
    assert parse_state(state_message(state, "simulator")) == state


def test_report_of_an_older_lock_is_read_with_distinct_stops() -> None:
    def report(turn: int) -> DiagnosticStatus:
        values = {"locked": "true", "turn": str(turn), "stops": f'[["a", "anna", "now", {turn}]]', "instance": "1"}
        return DiagnosticStatus(values=[KeyValue(key=key, value=value) for key, value in values.items()])

    latch = Latch()
    assert latch.follow(parse_state(report(1)).lock) and latch.lock.holder == "anna"
    release(latch, *latch.lock.ids)
    assert not latch.follow(parse_state(report(1)).lock) and latch.follow(parse_state(report(3)).lock)


@pytest.mark.parametrize("text", ["x" * 1000, "\ud800" * 1000, "[" * 1000, "9" * 1000])
def test_lock_report_is_read_by_another_lock_whatever_texts_it_was_sent(text: str) -> None:
    """Otherwise a release of the stop as one lock reports it would not match the stop that the other holds."""
    keys = ("request", "id", "stops", "turn", "instance", "holder")
    message = DiagnosticStatus(
        name=text, message=text, hardware_id=text, values=[KeyValue(key=key, value=text) for key in keys]
    )
    latch = Latch()
    latch.request(parse_request(message), 0)
    latch.follow(parse_state(message).lock)
    assert len(latch.lock.stops) == 2
    assert parse_state(state_message(State(latch.lock, "1"), "node")).lock == latch.lock


def test_unreadable_state_counts_as_locked() -> None:
    assert parse_state(DiagnosticStatus()).lock.held
    assert parse_request(DiagnosticStatus()).verb == ""


@pytest.mark.parametrize("text", ["", "[", "{}", "[[]]", "[1, 2]", "[[1, 2, 3, 4], null]", '["*"]', "[" * 100_000])
def test_unreadable_stops_are_one_stop_and_unreadable_release_releases_nothing(text: str) -> None:
    state = DiagnosticStatus(values=[KeyValue(key="locked", value="true"), KeyValue(key="stops", value=text)])
    assert len(parse_state(state).lock.stops) == 1
    values = [KeyValue(key="request", value="release"), KeyValue(key="ids", value=text)]
    asked = parse_request(DiagnosticStatus(hardware_id="b", values=values))
    assert asked.ids == (("*",) if "*" in text else ())
    latch = Latch()
    latch.request(ANNA, 0)
    assert not latch.request(asked, 0) and latch.lock.held
