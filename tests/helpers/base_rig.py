"""A robot's base with a lock, in a separate domain, to which a console connects."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from bot_console.tui.console.robot import robot_drive
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, EmergencyStop
from domains import unused_domain
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rigs import TIMEOUT_S


class Base:
    """A robot's base with a lock, spun in a thread."""

    def __init__(self, domain: int) -> None:
        self.context = Context()
        self.context.init(["test"], domain_id=domain)
        self.node = Node("simulator", context=self.context)
        self.stop = EmergencyStop(self.node, Clock(clock_type=ClockType.STEADY_TIME), BASE, ARBITER, lambda: None)
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._executor.spin, daemon=True)
        self._thread.start()

    def is_held(self) -> bool:
        return self.stop.lock.held

    def close(self) -> None:
        self._executor.shutdown()
        self._thread.join(TIMEOUT_S)
        self.node.destroy_node()
        self.context.try_shutdown()


@contextmanager
def served_base(monkeypatch: pytest.MonkeyPatch) -> Iterator[Base]:
    """A base in a new domain; consoles that are made in the block join this domain."""
    domain = unused_domain()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)
    made = Base(domain)
    yield made
    made.close()
