"""Collects the diagnostics of the whole system by name, with the history of each."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics, Level, ReportedStatus, Status
from bot_console.tui.console.topics.offered_topics import offered_qos, offered_types_of
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.node import Node

TYPE = "diagnostic_msgs/msg/DiagnosticArray"
AGGREGATED = "_agg"
"""Suffix of the topic of an aggregator, which repeats the statuses of the other topics under different names."""
MAX_NAMES = 1000
"""The number of names kept."""
MAX_CHANGES_PER_NAME = 100
"""The number of changes kept per name."""


class DiagnosticsWatch:
    """Subscribes to every diagnostics topic, or only to the aggregator's if there is one."""

    def __init__(self, node: Node, clock: Callable[[], float] = time.monotonic) -> None:
        self._node = node
        self._clock = clock
        self._subscriptions: dict[str, tuple[object, Any]] = {}
        self._statuses: dict[str, Status] = {}
        self._dropped = 0
        self._info = Diagnostics()

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        reported = {each.name for node in graph.nodes for each in node.publishers if TYPE in each.types}
        reported = {each for each in reported if each.endswith(AGGREGATED)} or reported
        wanted = {
            topic: offered_qos(graph, topic)
            for topic in sorted(reported)
            if offered_types_of(graph, topic)[:1] == (TYPE,)
        }
        for topic, (offer, subscription) in tuple(self._subscriptions.items()):
            if topic not in wanted or wanted[topic].key != offer:
                self._node.destroy_subscription(subscription)
                del self._subscriptions[topic]
        for topic, offer in wanted.items():
            if topic not in self._subscriptions:
                made = self._node.create_subscription(DiagnosticArray, topic, self.take, offer.profile())
                self._subscriptions[topic] = (offer.key, made)
        if self._info.topics != tuple(wanted):
            self._report()

    def take(self, message: DiagnosticArray) -> None:
        """Process a message of a diagnostics topic."""
        stamp, last_received = time.time_ns(), self._clock()
        found = dict(self._statuses)
        for each in message.status:
            before = found.get(each.name)
            if before is None and len(found) >= MAX_NAMES:
                self._dropped += 1
            else:
                found[each.name] = _status(each, before, stamp, last_received)
        self._statuses = found
        self._report()

    def _report(self) -> None:
        statuses = tuple(self._statuses.values())
        self._info = Diagnostics(statuses, tuple(sorted(self._subscriptions)), self._dropped)

    def diagnostics(self) -> Diagnostics:
        """The latest statuses; from any thread."""
        return self._info


def _status(new: DiagnosticStatus, before: Status | None, stamp: int, last_received: float) -> Status:
    level = _level(new.level)
    history = before.history if before else ()
    if not history or history[-1].level is not level or (level is not Level.OK and history[-1].message != new.message):
        history = (*history, ReportedStatus(stamp, level, str(new.message)))[-MAX_CHANGES_PER_NAME:]
    values = tuple((str(each.key), str(each.value)) for each in new.values)
    return Status(str(new.name), level, str(new.message), str(new.hardware_id), values, last_received, history)


def _level(code: Any) -> Level:
    """Convert a level, which is a byte in Jazzy and a number elsewhere; an unknown level counts as an error."""
    number = code[0] if isinstance(code, bytes) and code else code
    return Level(number) if number in tuple(Level) else Level.ERROR
