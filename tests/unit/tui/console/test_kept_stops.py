"""A stop holds until a person releases it, whatever happens to locks and consoles, and then does not come back."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from bot_console.tui.console.robot import stop_link
from bot_console.tui.console.robot.stop_link import RELEASE_TIMEOUT_S, REPORT_TIMEOUT_S, StopLink
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, LATCHED, EmergencyStop
from bot_console_robot.safety.lock import Lock, Stop
from bot_console_robot.safety.stop_messages import State, state_message
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from fakes.lossy_bus import BusNode, LossyBus
from stop_rig import REQUEST, StopRig

Disturbance = Callable[[StopRig], object]
MONITOR, BASE_NODE = "safety_monitor", "simulator"


@pytest.fixture
def rig(tmp_path: Path) -> Iterator[StopRig]:
    """A robot with a stop file, followed by the consoles of anna and ben; all messages are recorded."""
    made = StopRig(str(tmp_path / "stops.json"))
    made.robot()
    made.console("anna")
    made.console("ben")
    made.record()
    made.settle()
    yield made
    made.close()


def restart(rig: StopRig, *names: str) -> None:
    rig.kill(*names)
    for name in names:
        rig.lock(name)


def down_and_up(rig: StopRig) -> None:
    rig.kill(MONITOR, BASE_NODE)
    rig.settle()
    rig.robot()


def killed_console_and_up(rig: StopRig) -> None:
    rig.kill("anna")
    down_and_up(rig)


def robot_without_file(rig: StopRig) -> None:
    """Only the consoles remember the stop."""
    rig.stop_file = ""
    down_and_up(rig)


def file_lost(rig: StopRig) -> None:
    """The state folder is emptied while the locks run; later everything ends at once."""
    Path(rig.stop_file).unlink()
    rig.report()
    killed_console_and_up(rig)


def file_of_yesterday(rig: StopRig) -> None:
    """A backup without the stop replaces the file."""
    path = Path(rig.stop_file)
    path.with_name("backup").write_text('{"version": 1, "robots": {}}')
    path.with_name("backup").replace(path)
    rig.report()
    killed_console_and_up(rig)


DISTURBANCES: dict[str, Disturbance] = {
    "monitor restarted": lambda rig: restart(rig, MONITOR),
    "base restarted": lambda rig: restart(rig, BASE_NODE),
    "both restarted at once": lambda rig: restart(rig, MONITOR, BASE_NODE),
    "down and up": down_and_up,
    "console killed": lambda rig: rig.kill("anna"),
    "console killed, then down and up": killed_console_and_up,
    "another start without the file": robot_without_file,
    "file deleted, console killed, then down and up": file_lost,
    "file replaced, console killed, then down and up": file_of_yesterday,
    "bag played": lambda rig: rig.play(),
    "restarted, and bag played": lambda rig: (restart(rig, MONITOR, BASE_NODE), rig.settle(), rig.play()),
}


@pytest.mark.parametrize("disturb", DISTURBANCES.values(), ids=DISTURBANCES)
def test_a_stop_holds_whatever_happens_until_a_person_releases_it(rig: StopRig, disturb: Disturbance) -> None:
    rig.links["anna"].stop("an earlier stop")
    rig.settle()
    rig.links["anna"].release()
    rig.settle()
    assert not held(rig)
    rig.links["anna"].stop("the arm swings")
    rig.settle()
    disturb(rig)
    rig.settle(2)
    rig.report()
    assert held(rig) and all("the arm swings" in reasons(lock) for lock in rig.locks.values())
    ben = rig.links["ben"]
    assert ben.info.confirmed and "the arm swings" in [each.reason for each in ben.info.stops]
    ben.release([each.key for each in ben.info.stops])
    rig.settle(2)
    assert not held(rig)


@pytest.mark.parametrize("disturb", DISTURBANCES.values(), ids=DISTURBANCES)
def test_a_stop_released_by_somebody_else_does_not_come_back(rig: StopRig, disturb: Disturbance) -> None:
    rig.links["anna"].stop("the arm swings")
    rig.settle()
    ben = rig.links["ben"]
    ben.release([each.key for each in ben.info.stops])
    rig.settle(2)
    assert not held(rig) and not rig.links["anna"].info.stopped
    disturb(rig)
    rig.settle(2)
    assert all("the arm swings" not in reasons(lock) for lock in rig.locks.values())


def held(rig: StopRig) -> bool:
    """Whether all locks hold the robot; fails if they disagree."""
    [agreed] = {lock.lock.held for lock in rig.locks.values()}
    return agreed


def reasons(lock: EmergencyStop) -> list[str]:
    return [each.reason for each in lock.lock.stops]


def test_a_replayed_release_releases_no_stop_and_is_logged(rig: StopRig, monkeypatch: pytest.MonkeyPatch) -> None:
    """Recorded when it had no effect, as if it had been lost in transit."""
    lines: list[str] = []
    for name in (MONITOR, BASE_NODE):
        monkeypatch.setattr(rig.nodes[name].get_logger(), "warning", lambda text, **_: lines.append(text))
    rig.links["anna"].stop("the arm swings")
    rig.settle()
    stop = rig.links["anna"].info.stops[0]
    values = {"request": "release", "ids": json.dumps([stop.key]), "challenges": '["of another state"]'}
    rig.recorded = [(REQUEST, DiagnosticStatus(name="anna", values=pairs(values)))]
    rig.recorded.append((REQUEST, DiagnosticStatus(name="anna", values=pairs({"request": "release", "of": '["a"]'}))))
    rig.play()
    assert held(rig)
    assert len([each for each in lines if "Release by anna ignored" in each]) >= 2


def test_a_replayed_lock_report_does_not_confirm_the_next_stop(rig: StopRig) -> None:
    anna = rig.links["anna"]
    anna.stop("an earlier stop")
    rig.settle()
    anna.release()
    rig.settle()
    rig.kill(MONITOR, BASE_NODE)
    player = rig.node("player")
    reports = {topic: message for topic, message in rig.recorded if topic != REQUEST and "true" in str(message.values)}
    anna.stop("the arm swings")
    for topic, message in reports.items():
        player.create_publisher(DiagnosticStatus, topic, LATCHED).publish(message)
    rig.settle(2)
    assert reports and anna.info.locks == 2 and not anna.info.confirmed and anna.stopping


def test_after_a_bag_was_played_every_console_shows_the_actual_state(rig: StopRig) -> None:
    ben = rig.links["ben"]
    rig.links["anna"].stop("the arm swings")
    rig.settle()
    rig.kill("anna")
    reports = [each for each in rig.recorded if each[0] != REQUEST]
    rig.recorded = [each for each in reports if "true" not in str(each[1].values)]
    rig.play()
    assert held(rig) and not ben.info.stopped, "the last report that ben has received is a recording"
    rig.report()
    assert ben.info.confirmed and [each.holder for each in ben.info.stops] == ["anna"]


def test_a_lock_that_no_longer_reports_confirms_nothing(rig: StopRig, monkeypatch: pytest.MonkeyPatch) -> None:
    anna, now = rig.links["anna"], time.monotonic()
    anna.stop("the arm swings")
    rig.settle()
    assert anna.info.confirmed
    monkeypatch.setattr("time.monotonic", lambda: now + 10.0)
    anna.repeat()
    assert not anna.info.confirmed and anna.info.stopped
    rig.report()
    assert anna.info.confirmed


def test_a_report_that_arrives_after_its_lock_has_left_is_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    bus, now = LossyBus(), [0.0]
    monkeypatch.setattr(stop_link, "time", SimpleNamespace(monotonic=lambda: now[0]))
    arbiter, base = f"/{ARBITER}", f"/{BASE}"
    anna = StopLink(cast(Any, BusNode(bus, "anna")), "anna", "anna")
    anna.follow({arbiter, base})
    held = Lock().with_stop(Stop(anna.stop("the arm swings"), "anna"))
    report = state_message(State(held, instance="1", challenge="any"), "lock")
    bus.send(base, report)
    anna.follow({arbiter})
    bus.settle()
    now[0] = 2 * REPORT_TIMEOUT_S
    bus.send(arbiter, report)
    bus.settle()
    assert anna.info.locks == 1 and anna.info.confirmed


@pytest.mark.parametrize("silent", [False, True])
def test_a_release_is_repeated_as_long_as_the_locks_report(
    silent: bool, rig: StopRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    monkeypatch.setattr(stop_link, "time", SimpleNamespace(monotonic=lambda: now[0]))
    anna = rig.links["anna"]
    press = anna.add_stop("ALL STOP")
    rig.settle()
    for lock in rig.locks.values():
        lock.stop("robot", "a fault")  # A different challenge, which anna has not received: her release is refused.
    anna.withdraw(press)
    now[0] = RELEASE_TIMEOUT_S + 0.5
    if silent:
        now[0] += REPORT_TIMEOUT_S
        anna.repeat()  # The locks have sent nothing meanwhile: nobody would expect a release that is sent later.
    rig.settle(3)
    assert all((press in lock.lock.ids) is silent for lock in rig.locks.values())
    assert all(lock.lock.held for lock in rig.locks.values())


def test_robot_is_held_again_if_an_abandoned_release_arrives_late(
    rig: StopRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    monkeypatch.setattr(stop_link, "time", SimpleNamespace(monotonic=lambda: now[0]))
    anna = rig.links["anna"]
    anna.stop("ALL STOP")
    rig.settle()
    anna.release()  # it waits in the link, since nothing is received meanwhile
    now[0] = RELEASE_TIMEOUT_S + REPORT_TIMEOUT_S + 0.5
    anna.repeat()
    assert anna.info.stopped and not anna.info.confirmed
    rig.settle(3)
    assert anna.info.confirmed and anna.info.reason == stop_link.UNANSWERED
    anna.release()
    rig.settle()
    assert not anna.info.stopped and not any(lock.lock.held for lock in rig.locks.values())


def test_lock_that_falls_silent_long_after_a_release_causes_no_stop(
    rig: StopRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    monkeypatch.setattr(stop_link, "time", SimpleNamespace(monotonic=lambda: now[0]))
    anna = rig.links["anna"]
    anna.stop("ALL STOP")
    rig.settle()
    anna.follow([])  # the locks are gone, and nothing else could answer
    anna.release()
    now[0] = RELEASE_TIMEOUT_S + 0.5
    anna.repeat()
    rig.settle()
    rig.report()
    now[0] += REPORT_TIMEOUT_S + 0.5
    anna.repeat()
    assert not anna.has_stop


def test_a_stop_without_locks_is_unconfirmed_and_sent_to_new_locks(
    rig: StopRig,
) -> None:
    rig.stop_file = ""
    anna = rig.links["anna"]
    anna.stop("the arm swings")
    rig.settle()
    assert anna.info.confirmed
    rig.kill(MONITOR, BASE_NODE)
    rig.settle()
    assert (anna.info.stopped, anna.info.confirmed, anna.info.here, anna.info.locks) == (True, False, True, 0)
    rig.robot()
    rig.settle(2)
    assert held(rig) and anna.info.confirmed


def test_one_of_two_stops_of_a_console_can_be_withdrawn_alone(rig: StopRig) -> None:
    anna = rig.links["anna"]
    first, second = anna.stop("the arm swings"), anna.add_stop("! typed while keys were waiting")
    assert anna.stop("the arm swings") == first != second
    rig.settle()
    anna.withdraw(second)
    rig.settle(2)
    assert held(rig) and [each.key for each in anna.info.stops] == [first] and anna.info.confirmed
    anna.withdraw(first)
    rig.settle(2)
    assert not held(rig)


@pytest.mark.parametrize("interleaved", [False, True])
def test_stops_that_are_withdrawn_one_after_the_other_are_all_released(rig: StopRig, interleaved: bool) -> None:
    """Each release changes the challenge that the next one has to quote."""
    anna = rig.links["anna"]
    if interleaved:
        for _ in range(3):
            anna.withdraw(anna.add_stop("! typed while keys were waiting"))
    else:
        for each in [anna.add_stop("! typed while keys were waiting") for _ in range(3)]:
            anna.withdraw(each)
    rig.settle(4)
    assert not held(rig) and not anna.releasing


def test_a_stop_made_by_the_console_itself_ends_with_robot_and_console(rig: StopRig) -> None:
    rig.links["anna"].stop("bot-console was quit", kept=False)
    rig.settle()
    restart(rig, MONITOR)
    rig.settle(2)
    assert "bot-console was quit" in reasons(rig.locks[MONITOR])
    killed_console_and_up(rig)
    rig.settle(2)
    assert not held(rig)


def test_a_stop_by_service_call_survives_a_restart_and_a_call_releases_it(rig: StopRig) -> None:
    from std_srvs.srv import Trigger

    def call(lock: EmergencyStop, verb: str) -> Trigger.Response:
        return getattr(lock, f"_on_{verb}")(Trigger.Request(), Trigger.Response())

    assert call(rig.locks[BASE_NODE], "stop").success
    rig.settle()
    down_and_up(rig)
    rig.settle()
    assert held(rig)
    assert call(rig.locks[MONITOR], "release").success
    rig.settle(2)
    assert not held(rig)


def test_an_unreadable_stop_file_locks_and_a_release_moves_it_aside(rig: StopRig, tmp_path: Path) -> None:
    path = Path(rig.stop_file)
    rig.kill(MONITOR, BASE_NODE)
    path.write_text("{")
    rig.robot()
    rig.settle(2)
    assert held(rig) and "cannot be read" in rig.links["ben"].info.reason
    ben = rig.links["ben"]
    ben.release([each.key for each in ben.info.stops])
    rig.settle(2)
    assert not held(rig) and path.with_name("stops.json.unreadable").read_text() == "{"
    down_and_up(rig)
    rig.settle()
    assert not held(rig)


def test_no_release_frees_the_robot_while_the_stop_file_cannot_be_written(rig: StopRig) -> None:
    path = Path(rig.stop_file)
    rig.kill(MONITOR, BASE_NODE)
    rig.stop_file = str(path / "stops.json")  # its parent is a file
    rig.robot()
    rig.settle(2)
    ben = rig.links["ben"]
    for _ in range(2):
        assert held(rig) and "cannot be written" in ben.info.reason
        ben.release([each.key for each in ben.info.stops])
        rig.settle(2)
    path.unlink()
    ben.release([each.key for each in ben.info.stops])
    rig.settle(2)
    assert not held(rig)


@pytest.mark.parametrize("everybody", [False, True])
@pytest.mark.parametrize("reported", [False, True])
def test_a_release_that_could_not_be_written_leaves_the_robot_held_after_repair_and_restart(
    reported: bool, everybody: bool, rig: StopRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read_only(*words: object) -> int:
        raise OSError(30, "Read-only file system")

    anna, ben = rig.links["anna"], rig.links["ben"]
    anna.stop("the arm swings")
    for name, lock in rig.locks.items():
        lock.stop(name, "a reason of its own, which ends with the node")
    rig.settle(2)
    with monkeypatch.context() as disk:
        disk.setattr(os, "replace", read_only)
        anna.release([each.key for each in ben.info.stops] if everybody else [])
        rig.settle(2)
        assert held(rig) and "Read-only file system" in str(ben.info.stops)
    if reported:
        rig.report()
    rig.kill("anna")
    restart(rig, MONITOR, BASE_NODE)
    rig.settle(2)
    assert held(rig), "it was reported as not released"
    ben.release([each.key for each in ben.info.stops])
    rig.settle(2)
    assert not held(rig)
    restart(rig, MONITOR, BASE_NODE)
    rig.settle(2)
    assert not held(rig)


def test_a_stop_that_could_not_be_written_is_written_as_soon_as_there_is_space(
    rig: StopRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(handle: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr(os, "fsync", full)
        anna = rig.links["anna"].stop("the arm swings")
        rig.settle(2)
        reasons = {each.reason for lock in rig.locks.values() for each in lock.lock.stops}
        assert any("No space left on device" in each for each in reasons)
    rig.report()
    killed_console_and_up(rig)
    rig.settle()
    assert all(anna in lock.lock.ids for lock in rig.locks.values())


def older_request(verb: str, key: str, **values: str) -> DiagnosticStatus:
    return DiagnosticStatus(name=key, hardware_id=key, values=pairs({"request": verb, **values}))


def pairs(values: dict[str, str]) -> list[KeyValue]:
    return [KeyValue(key=key, value=value) for key, value in values.items()]


def test_an_older_console_stops_and_releases_with_these_locks(rig: StopRig) -> None:
    publisher = rig.node("older").create_publisher(DiagnosticStatus, REQUEST, 10)
    rig.settle()
    for _ in range(2):
        publisher.publish(older_request("stop", "old"))
        publisher.publish(older_request("stop", "old"))
        rig.settle(2)
        assert held(rig) and {row[0] for row in json.loads(last_values(rig, BASE)["stops"])} == {"old"}
        publisher.publish(older_request("release", "old", of='["old", "node"]'))
        rig.settle(2)
        assert not held(rig)


def last_values(rig: StopRig, topic: str) -> dict[str, str]:
    message = [message for each, message in rig.recorded if each == topic][-1]
    return {each.key: each.value for each in message.values}


class OlderLock:
    """A lock that does not distinguish stops with the same key, and reports neither releases nor challenges."""

    def __init__(self, rig: StopRig, instance: str) -> None:
        node = rig.node(f"older{instance}")
        self.instance = instance
        self.stops: dict[str, list[object]] = {}
        self._states = node.create_publisher(DiagnosticStatus, BASE, LATCHED)
        node.create_subscription(DiagnosticStatus, REQUEST, self._on_request, 10)
        self.publish()

    def _on_request(self, message: DiagnosticStatus) -> None:
        values = {each.key: each.value for each in message.values}
        before = dict(self.stops)
        if values["request"] == "stop":
            self.stops.setdefault(message.hardware_id, [message.hardware_id, message.name, message.message, 1])
        elif values["request"] == "release":
            for key in json.loads(values["of"]):
                self.stops.pop(key, None)
        if self.stops != before:
            self.publish()

    def publish(self) -> None:
        locked = str(bool(self.stops)).lower()
        values = {"locked": locked, "stops": json.dumps(list(self.stops.values())), "instance": self.instance}
        self._states.publish(DiagnosticStatus(values=pairs(values)))


@pytest.fixture
def older_rig() -> Iterator[StopRig]:
    made = StopRig()
    yield made
    made.close()


def test_a_console_stops_releases_and_restores_its_stop_with_an_older_lock(older_rig: StopRig) -> None:
    lock = OlderLock(older_rig, "1")
    anna: StopLink = older_rig.console("anna")
    older_rig.settle()
    for _ in range(2):
        anna.stop("now")
        older_rig.settle(2)
        assert lock.stops and anna.info.confirmed
        anna.release()
        older_rig.settle(2)
        assert not (lock.stops or anna.info.stopped)
    anna.stop("now")
    older_rig.settle(2)
    older_rig.kill("older1")
    lock = OlderLock(older_rig, "2")
    older_rig.settle(2)
    assert lock.stops and anna.info.confirmed, "another start of the lock has lost it: nobody has released it"
    lock.stops.clear()
    lock.publish()
    older_rig.settle(2)
    assert not (lock.stops or anna.info.stopped), "the same start had it: somebody has released it"
