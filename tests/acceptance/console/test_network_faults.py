"""A console behind a bad link: the robot never waits for it, motion ends, and the state of the link is reported."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.rmw.local import LocalBus, local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.network.network_bus import NetworkBuses
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.tui.console.model import Severity
from bot_console.tui.panes.steering.state import Steering
from bot_console.tui.session.embedded.link_state import LinkStatus
from processes.bad_link import BadLink
from processes.ports import free_port
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rigs import ROBOT, RosRig, until
from std_msgs.msg import String

PERIOD = 0.1


class FarRig(RosRig):
    """The robot at its router, and the console behind a link that tests can disturb."""

    def __init__(self, folder: Path) -> None:
        self.place = Serving((f"tcp/127.0.0.1:{free_port()}",))
        self.router = Router(self.place)
        self.wire = BadLink(int(self.place.endpoints[0].rpartition(":")[2]))
        self._robot_buses: list[ZenohBus] = []
        self._console_buses = NetworkBuses(ClientConfig((f"tcp/127.0.0.1:{self.wire.port}",)))
        self.words = LinkStatus(self._console_buses)

        def robot_bus(domain: int) -> ZenohBus:
            self._robot_buses.append(
                ZenohBus(open_network_session(domain, ClientConfig(self.place.endpoints)), LocalBus())
            )
            return self._robot_buses[-1]

        def sides(side: str) -> None:
            choose_middleware(robot_bus if side == "robot" else self._console_buses)

        try:
            super().__init__(folder, sides, link=self.words.info)
        finally:
            choose_middleware(local_bus)

    def driving(self, ended: threading.Event) -> None:
        """Hold a key: send a command ten times a second, as the pane does."""
        while not ended.wait(PERIOD):
            self.console.drive.move(0.5, 0.0)

    def publish_long(self) -> Publisher:
        """Make a publisher of the robot for long messages."""
        return self._node.create_publisher(String, "/long", QoSProfile(depth=10))

    def close(self) -> None:
        self.wire.restore()
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
    """A key that a separate thread holds until the event is set."""
    ended = threading.Event()
    thread = threading.Thread(target=far.driving, args=(ended,))
    thread.start()
    until(lambda: (0.5, 0.0) in far.received, "a command")
    yield ended
    ended.set()
    thread.join()


@pytest.mark.parametrize("seconds", [2, pytest.param(30, marks=pytest.mark.soak)])
def test_cut_link_is_reported_and_the_robot_does_not_move_when_it_returns(
    far: FarRig, key: threading.Event, seconds: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigs.TIMEOUT_S", seconds + 20.0)
    assert far.console.snapshot().link.silent_s == 0
    far.wire.cut()
    reported = [0]

    def silent() -> bool:
        reported.append(far.console.snapshot().link.silent_s)
        assert reported[-1] >= reported[-2], (
            "no answer may arrive over a cut link"
        )  # Zenoh gives up on it in the same way, after 10 s.
        return reported[-1] >= seconds

    until(silent, "the silence")
    sent_at_most = 3.5 / PERIOD  # A command is refused 1 s after the last answer, which is requested every 1.3 s.
    far.publish(1.0)  # The robot waits for nobody.
    before = len(far.received)
    far.wire.restore()
    until(lambda: (0.0, 0.0) in far.received[before:], "the zero at the end of what had waited")
    late = list(far.received[before:])
    assert late.index((0.0, 0.0)) <= sent_at_most
    until(lambda: far.console.snapshot().link.silent_s == 0, "the link")
    zero = before + late.index((0.0, 0.0))
    until(lambda: (0.5, 0.0) in far.received[zero:], "commands of the key that is still held")


@pytest.mark.soak
def test_robot_driven_before_a_long_loss_gets_a_zero_when_the_link_returns(
    far: FarRig, key: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigs.TIMEOUT_S", 40.0)
    far.wire.cut()
    until(lambda: far.console.snapshot().link.silent_s >= 15, "that Zenoh has given the link up, and what waited in it")
    key.set()  # The disarmed pane does the same.
    before = len(far.received)
    far.wire.restore()
    until(lambda: far.console.snapshot() and len(far.received) > before, "a command")
    assert set(far.received[before:]) == {(0.0, 0.0)}


def test_robot_does_not_wait_for_a_console_with_a_cut_link(far: FarRig) -> None:
    publisher, heard = far.publish_long(), far.console.topics
    heard.listen("/long")
    until(lambda: publisher.get_subscription_count() > 0, "the subscription")
    far.wire.cut()
    text, longest = String(data="x" * 10_000), 0.0
    for _ in range(3000):  # More than the buffers of the link hold.
        began = time.monotonic()
        publisher.publish(text)
        longest = max(longest, time.monotonic() - began)
    assert longest < 1.0  # Waiting for a full link would take 2 s.


@pytest.mark.soak
def test_console_reconnects_after_the_router_was_killed(far: FarRig) -> None:
    far.router.close()
    until(lambda: ROBOT not in far.console.snapshot().parameters, "that the robot is gone")
    until(lambda: far.console.snapshot().link.silent_s >= 1, "that it is told")
    assert not far.console.snapshot().problem
    far.router = Router(far.place)
    until(lambda: ROBOT in far.console.snapshot().parameters, "the robot again")
    until(lambda: far.console.snapshot().link.silent_s == 0, "the link")
    (outcome,) = far.console.parameters.set(ROBOT, {"speed": 0.5}).result(240)
    assert outcome.accepted


@pytest.mark.soak
def test_everything_works_with_300_ms_delay_and_held_segments(far: FarRig) -> None:
    far.wire.delay, far.wire.hold, far.wire.held_share = 0.15, 0.5, 0.02
    until(lambda: (far.console.snapshot().link.delay_ms or 0) >= 290, "the delay to be told")
    (outcome,) = far.console.parameters.set(ROBOT, {"speed": 0.25}).result(240)
    assert outcome.accepted
    ended = threading.Event()
    thread = threading.Thread(target=far.driving, args=(ended,))
    thread.start()
    until(lambda: (0.5, 0.0) in far.received, "a command")
    ended.set()
    thread.join()
    far.console.drive.stop(True)
    stopped, count = time.monotonic(), len(far.received)
    until(lambda: far.received[-1] == (0.0, 0.0) and len(far.received) > count, "the stop")
    assert time.monotonic() - stopped < 3.0  # The delay one way, a held segment, and the slowness of a busy machine.
    far.show_text(Severity.WARN, "still here")
    until(lambda: far.console.snapshot().logs.counts.get(Severity.WARN, 0) >= 1, "the log")


def test_over_a_slow_link_robot_stands_after_dead_man_time_and_a_round_trip(far: FarRig) -> None:
    far.wire.delay, far.wire.hold, far.wire.held_share = 0.15, 0.5, 0.02
    steering, tick = Steering(deadman=1.0), threading.Event()
    steering.arm(time.monotonic())
    steering.steer(1, 0, 10, time.monotonic())  # The last key press.

    def stands() -> bool:
        """Send velocities as the pane does, ten times a second; return whether the robot stands."""
        tick.wait(PERIOD)
        command = steering.command(time.monotonic())
        if command is not None:
            far.console.drive.move(*command)
        return steering.expired and far.received[-1] == (0.0, 0.0)

    until(stands, "the zero")
    took = time.monotonic() - steering.last_key
    assert (0.5, 0.0) in far.received
    assert took < steering.deadman + 0.3 + 2 * 0.5 + 1.0  # The delay both ways, held segments, a busy machine.


@pytest.mark.soak
def test_corrupted_frames_end_the_connection_and_a_new_one_replaces_it(far: FarRig) -> None:
    far.wire.spoil = lambda data: bytes(each ^ 0x5A for each in data)
    far.show_text(Severity.WARN, "garbled")
    until(lambda: far.console.snapshot().link.silent_s >= 1, "that nothing comes through")
    assert not far.console.snapshot().problem
    far.wire.spoil = None
    far.wire.break_connections()
    until(lambda: ROBOT in far.console.snapshot().parameters and not far.console.snapshot().link.silent_s, "the robot")
