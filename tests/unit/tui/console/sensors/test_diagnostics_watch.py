"""Diagnostics of real nodes, as the console receives them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.sensors import diagnostics_watch as module
from bot_console.tui.console.sensors.diagnostic_status import Level
from bot_console.tui.console.sensors.diagnostics_watch import MAX_CHANGES_PER_NAME, TYPE, DiagnosticsWatch
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from piloting import Clock


class FakeNode:
    """Keeps its subscriptions."""

    def __init__(self) -> None:
        self.topics: list[str] = []

    def create_subscription(self, kind: Any, topic: str, callback: Any, profile: Any) -> Any:
        self.topics.append(topic)
        return SimpleNamespace(topic=topic)

    def destroy_subscription(self, subscription: Any) -> None:
        self.topics.remove(subscription.topic)


def output(level: bytes | int, message: str = "", name: str = "motor", **values: str) -> DiagnosticArray:
    one = DiagnosticStatus(level=level, name=name, message=message, hardware_id="arm")
    one.values = [KeyValue(key=key, value=value) for key, value in values.items()]
    return DiagnosticArray(status=[one])


def graph(*topics: str) -> GraphInfo:
    ends = tuple(Endpoint(each, (TYPE,), "reliable volatile 10") for each in topics)
    return GraphInfo((NodeInfo("/robot", ends),), ends)


def test_the_newest_status_of_each_name_is_kept_with_values_and_time() -> None:
    clock = Clock()
    watch = DiagnosticsWatch(FakeNode(), clock)
    watch.take(output(DiagnosticStatus.OK, "fine", temperature="40"))
    clock.now += 2.0
    watch.take(output(DiagnosticStatus.WARN, "warm", temperature="70"))
    [status] = watch.diagnostics().statuses
    assert (status.level, status.message, status.hardware, status.values, status.last_received) == (
        Level.WARN, "warm", "arm", (("temperature", "70"),), 102.0,
    )  # fmt: skip
    assert watch.diagnostics() is watch.diagnostics(), "the same object until a message arrives"


def test_the_history_has_every_change_of_level_or_message_but_no_repetitions() -> None:
    watch = DiagnosticsWatch(FakeNode())
    for level, message in ((0, "10 Hz"), (0, "11 Hz"), (1, "warm"), (1, "warm"), (1, "hot"), (2, "dead"), (0, "10 Hz")):
        watch.take(output(bytes([level]), message))
    [status] = watch.diagnostics().statuses
    assert [(each.level.name, each.message) for each in status.history] == [
        ("OK", "10 Hz"), ("WARN", "warm"), ("WARN", "hot"), ("ERROR", "dead"), ("OK", "10 Hz"),
    ]  # fmt: skip


def test_names_and_history_are_limited(monkeypatch) -> None:
    monkeypatch.setattr(module, "MAX_NAMES", 3)
    watch = DiagnosticsWatch(FakeNode())
    for number in range(5):
        watch.take(output(b"\x00", name=f"part {number}"))
    assert (len(watch.diagnostics().statuses), watch.diagnostics().dropped) == (3, 2)
    for number in range(MAX_CHANGES_PER_NAME + 7):
        watch.take(output(b"\x01", f"{number}", name="part 0"))
    assert len(watch.diagnostics().statuses[0].history) == MAX_CHANGES_PER_NAME


def test_an_unknown_level_counts_as_error() -> None:
    watch = DiagnosticsWatch(FakeNode())
    watch.take(output(b"\x09"))
    assert watch.diagnostics().statuses[0].level is Level.ERROR


def test_an_aggregator_replaces_other_topics_while_it_exists() -> None:
    node = FakeNode()
    watch = DiagnosticsWatch(node)
    watch.follow(graph("/diagnostics", "/other/diagnostics"))
    assert watch.diagnostics().topics == ("/diagnostics", "/other/diagnostics") == tuple(node.topics)
    watch.follow(graph("/diagnostics", "/diagnostics_agg"))
    assert node.topics == ["/diagnostics_agg"]
    watch.follow(graph())
    assert node.topics == [] and watch.diagnostics().topics == ()
