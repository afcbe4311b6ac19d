"""A node tells its health once a second, in the names and types that every robot monitor knows."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from bot_console_robot.common.diagnostics import ERROR, OK
from bot_console_robot.common.health import PERIOD, HealthReport
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray


class FakeNode:
    def __init__(self) -> None:
        self.sent: list[DiagnosticArray] = []
        self.timers: list[tuple[float, Any]] = []

    def get_name(self) -> str:
        return "arm"

    def create_publisher(self, kind: Any, topic: str, depth: int) -> Any:
        assert (kind, topic) == (DiagnosticArray, "diagnostics")
        return SimpleNamespace(publish=self.sent.append)

    def create_timer(self, period: float, callback: Any) -> None:
        self.timers.append((period, callback))

    def get_clock(self) -> Any:
        return SimpleNamespace(now=lambda: SimpleNamespace(to_msg=lambda: Time(sec=7)))


def test_a_status_a_second_with_values_as_text() -> None:
    node, health = FakeNode(), [(OK, "fine", {"rate": 10.0, "on": True}), (ERROR, "dead", {})]
    HealthReport(node, "motor", lambda: health.pop(0))
    [(period, tell)] = node.timers
    assert period == PERIOD == 1.0
    tell()
    tell()
    first, second = (each.status[0] for each in node.sent)
    assert (first.name, first.level, first.message, node.sent[0].header.stamp.sec) == ("arm: motor", OK, "fine", 7)
    assert [(each.key, each.value) for each in first.values] == [("rate", "10"), ("on", "True")]
    assert (second.level, second.message) == (ERROR, "dead")
