"""A machine too busy to simulate in real time: reported once, without blaming the robot."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
import rclpy
from bot_console_robot.simulator_node import QUIET_NS, Simulator
from domains import unused_domain

SECOND = 1_000_000_000


def test_lag_is_reported_once_and_again_after_a_quiet_period(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    rclpy.init()
    try:
        node: Any = Simulator()
        reported: list[str] = []
        now = node._steady.now().nanoseconds
        monkeypatch.setattr(node, "_steady", SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=now)))
        monkeypatch.setattr(node, "get_logger", lambda: SimpleNamespace(warning=reported.append))
        for _ in range(5):
            now += 2 * SECOND
            node._tick()
        assert len(reported) == 1 and reported[0].startswith("Simulation lags: ")
        assert reported[0].endswith("too busy to simulate in real time; the robot is slow, not broken")
        now += QUIET_NS + SECOND
        node._tick()
        assert len(reported) == 2
    finally:
        rclpy.shutdown()
