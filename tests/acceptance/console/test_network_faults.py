"""A console at the end of a bad link: nothing of the robot waits for it, motion ends, and the state is told."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.rmw.local import LocalBus, local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.network.client import Way, open_network_session
from bot_console.runtime.rmw.zenoh.network.network_bus import NetworkBuses
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.tui.cli.attach.network import LinkWords
from bot_console.tui.console.model import Severity
from bot_console.tui.panes.steering.state import Steering
from processes.bad_link import BadLink
from processes.ports import free_port
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rigs import ROBOT, RosRig, until
from std_msgs.msg import String

PERIOD = 0.1


class FarRig(RosRig):
    """The robot at its router, the console behind a link that can be spoilt."""

    def __init__(self, folder: Path) -> None:
        self.place = Serving((f"tcp/127.0.0.1:{free_port()}",))
        self.router = Router(self.place)
        self.wire = BadLink(int(self.place.endpoints[0].rpartition(":")[2]))
        self._robot_buses: list[ZenohBus] = []
        self._console_buses = NetworkBuses(Way((f"tcp/127.0.0.1:{self.wire.port}",)))
        self.words = LinkWords(self._console_buses)

        def robot_bus(domain: int) -> ZenohBus:
            self._robot_buses.append(ZenohBus(open_network_session(domain, Way(self.place.endpoints)), LocalBus()))
            return self._robot_buses[-1]

        def sides(side: str) -> None:
            choose_middleware(robot_bus if side == "robot" else self._console_buses)

        try:
            super().__init__(folder, sides, link=self.words.info)
        finally:
            choose_middleware(local_bus)

    def driving(self, ended: threading.Event) -> None:
        """Hold a key: a command ten times a second, as the pane does."""
        while not ended.wait(PERIOD):
            self.console.drive(0.5, 0.0)

    def publish_long(self) -> Publisher:
        """A publisher of the robot whose messages may be long."""
        return self._node.create_publisher(String, "/long", QoSProfile(depth=10))

    def close(self) -> None:
        self.wire.hint()
        super().close()
        for each in self._robot_buses:
            each.close()
        self._console_buses.close()
        self.wire.close()
        self.router.close()


@pytest.fixture
def far(tmp_path: Path) -> Iterator[FarRig]:
    rig = FarRig(tmp_path)
    yield rig
    rig.close()


@pytest.fixture
def key(far: FarRig) -> Iterator[threading.Event]:
    """A key that is held until the event is set, by a thread of its own."""
    ended = threading.Event()
    thread = threading.Thread(target=far.driving, args=(ended,))
    thread.start()
    until(lambda: (0.5, 0.0) in far.received, "a command")
    yield ended
    ended.set()
    thread.join()


@pytest.mark.parametrize("seconds", [2, pytest.param(30, marks=pytest.mark.soak)])
def test_a_cut_link_is_reported_and_its_end_brings_no_motion_back(
    far: FarRig, key: threading.Event, seconds: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigs.TIMEOUT_S", seconds + 20.0)
    assert far.console.snapshot().link.silent_s == 0
    far.wire.cut()
    reported = [0]

    def silent() -> bool:
        reported.append(far.console.snapshot().link.silent_s)
        assert reported[-1] >= reported[-2], (
            "an answer over a link that is cut"
        )  # as when Zenoh gives it up, after 10 s
        return reported[-1] >= seconds

    until(silent, "the silence")
    sent_at_most = 3.5 / PERIOD  # a command is refused 1 s after the last answer, which is asked for every 1.3 s
    far.publish(1.0)  # the robot waits for nobody
    before = len(far.received)
    far.wire.hint()
    until(lambda: (0.0, 0.0) in far.received[before:], "the zero at the end of what had waited")
    late = list(far.received[before:])
    assert late.index((0.0, 0.0)) <= sent_at_most
    until(lambda: far.console.snapshot().link.silent_s == 0, "the link")
    zero = before + late.index((0.0, 0.0))
    until(lambda: (0.5, 0.0) in far.received[zero:], "commands of the key that is still held")


@pytest.mark.soak
def test_a_robot_that_was_driven_when_a_link_was_lost_for_long_gets_a_zero_when_it_is_back(
    far: FarRig, key: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigs.TIMEOUT_S", 40.0)
    far.wire.cut()
    until(lambda: far.console.snapshot().link.silent_s >= 15, "that Zenoh has given the link up, and what waited in it")
    key.set()  # as the pane does, which is disarmed
    before = len(far.received)
    far.wire.hint()
    until(lambda: far.console.snapshot() and len(far.received) > before, "a command")
    assert set(far.received[before:]) == {(0.0, 0.0)}


def test_a_robot_does_not_wait_for_a_console_whose_link_is_cut(far: FarRig) -> None:
    publisher, heard = far.publish_long(), far.console.traffic
    heard.listen("/long")
    until(lambda: publisher.get_subscription_count() > 0, "the subscription")
    far.wire.cut()
    text, longest = String(data="x" * 10_000), 0.0
    for _ in range(3000):  # more than fits into the ways there
        began = time.monotonic()
        publisher.publish(text)
        longest = max(longest, time.monotonic() - began)
    assert longest < 1.0  # s; to wait for a full link takes 2 s


def test_the_router_is_killed_and_comes_back(far: FarRig) -> None:
    far.router.close()
    until(lambda: ROBOT not in far.console.snapshot().parameters, "that the robot is gone")
    until(lambda: far.console.snapshot().link.silent_s >= 1, "that it is told")
    assert not far.console.snapshot().problem
    far.router = Router(far.place)
    until(lambda: ROBOT in far.console.snapshot().parameters, "the robot again")
    until(lambda: far.console.snapshot().link.silent_s == 0, "the link")
    (outcome,) = far.console.set_parameters(ROBOT, {"speed": 0.5}).result(20)
    assert outcome.accepted


def test_with_300_ms_and_held_segments_all_works_and_nothing_is_called_silent(far: FarRig) -> None:
    far.wire.delay, far.wire.hold, far.wire.held_share = 0.15, 0.5, 0.02
    until(lambda: (far.console.snapshot().link.delay_ms or 0) >= 290, "the delay to be told")
    (outcome,) = far.console.set_parameters(ROBOT, {"speed": 0.25}).result(20)
    assert outcome.accepted
    ended = threading.Event()
    thread = threading.Thread(target=far.driving, args=(ended,))
    thread.start()
    until(lambda: (0.5, 0.0) in far.received, "a command")
    ended.set()
    thread.join()
    far.console.all_stop(True)
    stopped, count = time.monotonic(), len(far.received)
    until(lambda: far.received[-1] == (0.0, 0.0) and len(far.received) > count, "the stop")
    assert time.monotonic() - stopped < 3.0  # a way there, a held segment, and what a busy machine takes
    far.show_text(Severity.WARN, "still here")
    until(lambda: far.console.snapshot().logs.counts.get(Severity.WARN, 0) >= 1, "the log")


def test_over_a_slow_link_the_robot_stands_after_the_dead_man_time_and_a_round_trip(far: FarRig) -> None:
    far.wire.delay, far.wire.hold, far.wire.held_share = 0.15, 0.5, 0.02
    steering, tick = Steering(deadman=1.0), threading.Event()
    steering.arm(time.monotonic())
    steering.steer(1, 0, 10, time.monotonic())  # the last key that anybody presses

    def stands() -> bool:
        """Send as the pane does, ten times a second."""
        tick.wait(PERIOD)
        command = steering.command(time.monotonic())
        if command is not None:
            far.console.drive(*command)
        return steering.expired and far.received[-1] == (0.0, 0.0)

    until(stands, "the zero")
    took = time.monotonic() - steering.last_key
    assert (0.5, 0.0) in far.received
    assert took < steering.deadman + 0.3 + 2 * 0.5 + 1.0  # the delay both ways, held segments, a busy machine


def test_spoilt_frames_end_the_connection_and_a_clean_one_takes_its_place(far: FarRig) -> None:
    far.wire.spoil = lambda data: bytes(each ^ 0x5A for each in data)
    far.show_text(Severity.WARN, "garbled")
    until(lambda: far.console.snapshot().link.silent_s >= 1, "that nothing comes through")
    assert not far.console.snapshot().problem
    far.wire.spoil = None
    far.wire.break_connections()
    until(lambda: ROBOT in far.console.snapshot().parameters and not far.console.snapshot().link.silent_s, "the robot")
