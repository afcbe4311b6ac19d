"""A node reports its health once a second, in the names and types that every robot monitor knows."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from bot_console_robot.common.diagnostics import ERROR, OK
from bot_console_robot.common.health import STATUS_PERIOD_S, HealthReport
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray


class FakeNode:
    def __init__(self) -> None:
        self.sent: list[DiagnosticArray] = []
        self.timers: list[tuple[float, Any]] = []
        self.listeners = 1

    def get_name(self) -> str:
        return "arm"

    def create_publisher(self, kind: Any, topic: str, depth: int) -> Any:
        assert (kind, topic) == (DiagnosticArray, "diagnostics")
        return SimpleNamespace(publish=self.sent.append, get_subscription_count=lambda: self.listeners)

    def create_timer(self, period: float, callback: Any) -> None:
        self.timers.append((period, callback))

    def get_clock(self) -> Any:
        return SimpleNamespace(now=lambda: SimpleNamespace(to_msg=lambda: Time(sec=7)))


def test_status_is_published_each_second_with_values_as_text() -> None:
    node, health = FakeNode(), [(OK, "fine", {"rate": 10.0, "on": True}), (ERROR, "dead", {})]
    HealthReport(node, "motor", lambda: health.pop(0))
    [(period, report)] = node.timers
    assert period == STATUS_PERIOD_S == 1.0
    report()
    report()
    first, second = (each.status[0] for each in node.sent)
    assert (first.name, first.level, first.message, node.sent[0].header.stamp.sec) == ("arm: motor", OK, "fine", 7)
    assert [(each.key, each.value) for each in first.values] == [("rate", "10"), ("on", "True")]
    assert (second.level, second.message) == (ERROR, "dead")


def test_status_without_subscribers_is_checked_but_not_built() -> None:
    node, polls = FakeNode(), [(OK, "fine", {"never shown": object()})] * 2
    node.listeners = 0
    HealthReport(node, "motor", polls.pop)
    [(_, report)] = node.timers
    report()
    assert (len(polls), node.sent) == (1, [])
    node.listeners = 1
    report()
    assert (len(polls), len(node.sent)) == (0, 1)
