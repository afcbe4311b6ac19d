"""A link to another machine that carries less than is published, or nothing for some seconds, is not cut."""

import itertools
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, NetworkSession, open_network_session
from bot_console.runtime.rmw.zenoh.settings import Serving
from polling import until
from processes.bad_link import BadLink
from processes.ports import free_port

pytestmark = pytest.mark.slow

RATE = 30_000.0
KEPT_BYTES = int(3 * RATE)
"""Size of a kept message that the link carries in three seconds: longer than a message may wait between processes."""
STALL_S = 2.5
PERIOD_S, POLL_S, TIMEOUT_S = 0.01, 0.1, 25.0
MAP, ODOMETRY, LOG, STOP = "0/map/t", "0/odom/t", "0/rosout/t", "0/emergency_stop/base/t"


@dataclass
class System:
    """A robot of two processes, one of which admits other machines, and a console behind a narrow link."""

    link: BadLink
    robot: MeshSession
    serving: MeshSession
    heard: dict[str, list[bytes]] = field(default_factory=lambda: {each: [] for each in (MAP, ODOMETRY, LOG, STOP)})
    ended: threading.Event = field(default_factory=threading.Event)

    def attach(self) -> NetworkSession:
        """Connect a console that subscribes to everything."""
        console = open_network_session(0, ClientConfig((f"tcp/127.0.0.1:{self.link.port}",), timeout_s=TIMEOUT_S))
        for key, messages in self.heard.items():
            console.declare_subscriber(
                key, lambda data, _, to=messages: to.append(data), history=1 if key == MAP else None
            )
        return console

    def overload(self) -> None:
        """Publish three times as much as the link carries, in a separate thread until the end."""

        def publish() -> None:
            while not self.ended.wait(PERIOD_S):
                odometry.put(bytes(int(3 * RATE * PERIOD_S)), b"")

        odometry = self.robot.declare_publisher(ODOMETRY)
        threading.Thread(target=publish, daemon=True).start()


@pytest.fixture
def system() -> Iterator[System]:
    port = free_port()
    robot, serving = MeshSession(0), MeshSession(0, Serving((f"tcp/127.0.0.1:{port}",)))
    made = System(BadLink(port, RATE), robot, serving)
    yield made
    made.ended.set()
    for each in (made.link, serving, robot):
        each.close()


def test_overloaded_link_carries_kept_messages_log_lines_and_stops(system: System) -> None:
    kept = system.robot.declare_publisher(MAP, cache=1)
    log, stop = system.robot.declare_publisher(LOG, blocking=True), system.robot.declare_publisher(STOP)
    kept.put(bytes(KEPT_BYTES), b"")
    system.overload()
    console = system.attach()
    until(lambda: system.heard[MAP], poll_s=POLL_S)
    both = (system.heard[LOG], system.heard[STOP])
    until(lambda: all(both), step=lambda: [each.put(b"first", b"") for each in (log, stop)], poll_s=POLL_S)
    numbers = itertools.count()
    lines = [b"%d" % number for number in range(10)]

    def publish() -> None:
        if (number := next(numbers)) < len(lines):
            log.put(lines[number], b"")
            stop.put(lines[number], b"")

    until(lambda: all(lines[-1] in messages for messages in both), step=publish, poll_s=POLL_S)
    for messages in both:
        assert [each for each in messages if each != b"first"] == lines
    assert system.heard[ODOMETRY] and system.link.connections == 1
    console.close()


def test_link_that_carries_nothing_for_some_seconds_is_not_cut(system: System) -> None:
    log = system.robot.declare_publisher(LOG, blocking=True)
    console = system.attach()
    until(lambda: system.heard[LOG], step=lambda: log.put(b"before", b""), poll_s=POLL_S)
    system.link.cut()
    end = time.monotonic() + STALL_S
    while time.monotonic() < end:
        log.put(bytes(1000), b"")
        threading.Event().wait(PERIOD_S)
    system.link.restore()
    until(lambda: b"after" in system.heard[LOG], step=lambda: log.put(b"after", b""), poll_s=POLL_S)
    assert system.link.connections == 1
    console.close()
