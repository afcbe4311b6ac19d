"""The emergency stop as the console sees it: sent again until it is acknowledged, and confirmed only then."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator

import pytest
from bot_console.tui.console.robot import stop_link
from bot_console.tui.console.robot.stop_link import FOLDER, LATCHED, StopLink
from bot_console_robot.safety import operator_silence
from bot_console_robot.safety.emergency_stop import BASE
from bot_console_robot.safety.stop_messages import State, state_message
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.serialization import deserialize_message, serialize_message
from stop_rig import StopRig

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; the tests measure no time."""


class Rig(StopRig):
    """A console's link, and locks of a robot that join on request."""

    def __init__(self) -> None:
        super().__init__()
        self.link = self.console("console", "anna")


@pytest.fixture
def rig() -> Iterator[Rig]:
    made = Rig()
    yield made
    made.close()


def test_a_stop_is_confirmed_once_every_lock_has_acknowledged_it(rig: Rig) -> None:
    arbiter, base = rig.lock("safety_monitor"), rig.lock("simulator")
    rig.settle()
    assert (rig.link.info.stopped, rig.link.info.locks) == (False, 2)
    rig.link.stop("the arm swings")
    assert (rig.link.info.stopped, rig.link.info.confirmed) == (True, False), "sent, not confirmed"
    rig.settle()
    info = rig.link.info
    assert (info.confirmed, info.holder, info.reason) == (True, "anna", "the arm swings")
    assert arbiter.lock.held and base.lock.held
    rig.link.release()
    rig.settle()
    assert not (rig.link.info.stopped or arbiter.lock.held or base.lock.held)


def test_requester_with_an_overlong_name_recognises_its_own_stop(rig: Rig) -> None:
    arbiter, link = rig.lock("safety_monitor"), rig.console("other", "h" * 300, "k" * 300)
    rig.settle()
    link.stop("the arm swings")
    rig.settle()
    (stop,) = link.info.stops
    assert stop.here and stop.holder == link.holder
    link.release()
    rig.settle()
    assert not arbiter.lock.held


@pytest.mark.parametrize("cleans", [True, False], ids=["with the text replaced", "without it"])
def test_text_that_cannot_be_encoded_does_not_prevent_a_stop(
    cleans: bool, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LOGNAME", "\udcff")
    monkeypatch.setattr("platform.node", lambda: "\udcfe")
    if not cleans:
        monkeypatch.setattr(stop_link, "encodable", lambda text: text)
    received: list[DiagnosticStatus] = []
    lock = rig.lock("simulator")
    rig.nodes["simulator"].create_subscription(DiagnosticStatus, FOLDER + "request", received.append, 10)
    sending = StopLink(rig.node("sending"))
    rig.settle()
    sending.follow([f"{FOLDER}base"])
    for publisher in sending._requests.values():
        monkeypatch.setattr(publisher, "publish", encoding(publisher.publish))
    sending.stop("\udcff too close")
    rig.settle()
    assert sending.info.confirmed and lock.lock.held
    assert lock.lock.reason == ("\ufffd too close" if cleans else "")
    assert [serialize_message(each) for each in received]


def encoding(publish: Callable[[DiagnosticStatus], None]) -> Callable[[DiagnosticStatus], None]:
    """Publish as if to another process, which needs every message serialized."""

    def encoded(message: DiagnosticStatus) -> None:
        publish(deserialize_message(serialize_message(message), DiagnosticStatus))

    return encoded


def test_a_stop_whose_text_cannot_be_encoded_is_reported_by_the_lock(rig: Rig) -> None:
    lock = rig.lock("simulator")
    # `publish` refuses such a text, but another middleware might deliver it.
    rig.nodes["simulator"].create_publisher(DiagnosticStatus, FOLDER + "request", 10)._publish_own(
        DiagnosticStatus(
            name="\ud800", message="\udcff", hardware_id="\udcff", values=[KeyValue(key="request", value="stop")]
        )
    )
    rig.settle()
    assert lock.lock.held
    assert serialize_message(state_message(State(lock.lock, "1"), "base"))
    assert rig.link.info.confirmed


def test_another_console_sees_the_holder_and_releases_the_stop_by_its_key(rig: Rig) -> None:
    rig.lock("simulator")
    other = StopLink(rig.node("other"), "ben")
    rig.settle()
    other.follow([f"{FOLDER}base"])
    other.stop("my foot")
    rig.settle()
    assert (rig.link.info.confirmed, rig.link.info.holder, rig.link.info.reason) == (True, "ben", "my foot")
    rig.link.release()
    rig.settle()
    assert other.info.stopped, "another person's stop stays"
    rig.link.release([each.key for each in rig.link.info.stops])
    rig.settle()
    assert not other.info.stopped


def test_two_consoles_hold_the_robot_and_each_withdraws_its_own_stop(rig: Rig) -> None:
    lock = rig.lock("simulator")
    other = StopLink(rig.node("other"), "ben")
    rig.settle()
    other.follow([f"{FOLDER}base"])
    other.stop("my foot")
    rig.settle()
    rig.link.stop("the arm swings")
    assert rig.link.info.stopped and not rig.link.info.confirmed, "a report of ben's stop does not acknowledge ours"
    rig.settle()
    assert [each.holder for each in rig.link.info.stops] == ["ben", "anna"] and rig.link.info.confirmed
    other.release()
    rig.settle()
    assert lock.lock.held and [each.holder for each in other.info.stops] == ["anna"] and not other.info.here
    rig.link.release()
    rig.settle()
    assert not (lock.lock.held or rig.link.info.stopped)


def test_release_sent_before_the_locks_have_reported_the_stop_is_repeated_until_they_have(rig: Rig) -> None:
    lock = rig.lock("simulator")
    rig.settle()
    rig.link.stop("the arm swings")
    rig.link.release()
    assert rig.link.releasing
    rig.settle()
    rig.link.repeat()
    rig.settle()
    assert not (lock.lock.held or rig.link.info.stopped or rig.link.releasing)


def test_a_lock_that_reports_only_that_it_is_locked_acknowledges_every_stop(rig: Rig) -> None:
    publisher = rig.node("plain").create_publisher(DiagnosticStatus, "emergency_stop/plain", LATCHED)
    publisher.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="false")]))
    rig.settle()
    rig.link.stop("now")
    publisher.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="true")]))
    rig.settle()
    assert rig.link.info.confirmed and len(rig.link.info.stops) == 1
    rig.link.release()
    assert rig.link.releasing, "repeated until the lock has received it"
    publisher.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="false")]))
    rig.settle()
    assert not (rig.link.releasing or rig.link.info.stopped)


def test_a_stop_is_repeated_until_a_late_lock_has_received_it(rig: Rig) -> None:
    rig.settle()
    rig.link.stop("now")
    assert (rig.link.info.stopped, rig.link.info.confirmed, rig.link.info.locks) == (True, False, 0)
    base = rig.lock("simulator")
    rig.settle()
    rig.link.repeat()
    rig.settle()
    assert base.lock.held and rig.link.info.confirmed


def test_a_lock_with_unreadable_reports_confirms_nothing(rig: Rig) -> None:
    rig.node("odd").create_publisher(DiagnosticStatus, "emergency_stop/odd", LATCHED).publish(DiagnosticStatus())
    rig.settle()
    rig.link.stop("now")
    rig.settle()
    assert (rig.link.info.stopped, rig.link.info.confirmed) == (True, False)


def test_the_console_in_control_is_shown_and_can_hand_back(rig: Rig) -> None:
    base = rig.lock("simulator")
    rig.settle()
    rig.link.steer()
    rig.settle()
    assert rig.link.info.steered_by == base.steered_by == "anna"
    rig.link.hand_back()
    rig.settle()
    assert not (rig.link.info.steered_by or base.steered_by or base.lock.held)


def test_stop_of_locks_that_missed_the_console_counts_as_its_own_until_released(
    rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    locks = rig.lock("safety_monitor"), rig.lock("simulator")
    rig.settle()
    rig.link.steer()
    rig.settle()
    monkeypatch.setattr(operator_silence, "SILENCE_TIMEOUT_NS", -1)
    rig.report()
    held = {id for lock in locks for id in lock.lock.ids}
    assert held and rig.link.info.own == held, "one press releases it, as the status line says"
    rig.link.release()
    assert rig.link.info.own == frozenset(), "while it is in transit, another press holds the robot"
    rig.settle(3)
    assert not (rig.link.info.own or rig.link.info.stopped or any(lock.lock.held for lock in locks))


def test_stop_that_one_lock_has_released_is_no_longer_the_consoles_own(rig: Rig) -> None:
    arbiter, base = rig.robot()
    rig.settle()
    id = rig.link.stop("the arm swings")
    rig.settle()
    rig.link._on_state(*release_report("berta", id, rig))
    assert rig.link.info.own == frozenset() and base.lock.held and arbiter.lock.held


def release_report(who: str, id: str, rig: Rig) -> tuple[str, object, DiagnosticStatus]:
    """The report of the base alone that somebody has released a stop, with the topic and the subscription."""
    topic = f"{FOLDER}{BASE.rpartition('/')[2]}"
    values = {"locked": "false", "challenge": "c", "released": json.dumps([[id, who]])}
    message = DiagnosticStatus(values=[KeyValue(key=key, value=value) for key, value in values.items()])
    return topic, rig.link._watches[topic], message


def test_waiting_for_a_stop_ends_with_the_last_acknowledgement_and_not_before(rig: Rig) -> None:
    rig.lock("safety_monitor")
    rig.lock("simulator")
    rig.settle()
    rig.link.stop("bot-console was quit")
    assert not rig.link.await_held(0.0), "nobody has acknowledged it"
    held: list[bool] = []
    waiting = threading.Thread(target=lambda: held.append(rig.link.await_held(TIMEOUT_S)))
    waiting.start()
    rig.settle()
    waiting.join(TIMEOUT_S)
    assert held == [True]
