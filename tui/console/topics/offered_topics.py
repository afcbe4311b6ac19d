"""The type of a topic, and a QoS compatible with all its publishers."""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.console.model import GraphInfo
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

DEPTH = 10


@dataclass(frozen=True)
class Offer:
    """The offered QoS: whether all publishers are reliable, and whether all are transient local."""

    reliable: bool
    latched: bool
    depth: int = DEPTH

    @property
    def key(self) -> tuple[bool, bool]:
        """The settings that have to stay the same for a subscription to remain suitable."""
        return self.reliable, self.latched

    def profile(self) -> QoSProfile:
        """The QoS profile for a subscription to the topic."""
        return QoSProfile(
            history=HistoryPolicy.KEEP_LAST,
            depth=self.depth,
            reliability=ReliabilityPolicy.RELIABLE if self.reliable else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if self.latched else DurabilityPolicy.VOLATILE,
        )


def offered_qos(graph: GraphInfo, topic: str) -> Offer:
    """The QoS that all publishers of a topic offer; reliable and volatile if nobody publishes yet."""
    profiles = [each.qos for node in graph.nodes for each in node.publishers if each.name == topic and each.qos]
    return Offer(
        all(not each.startswith("best effort") for each in profiles),
        bool(profiles) and all("transient local" in each for each in profiles),
    )


def offered_types_of(graph: GraphInfo, topic: str) -> tuple[str, ...]:
    """The types of a topic; those of publishers come before those of subscriptions."""
    nodes = graph.nodes
    published = (each for node in nodes for each in node.publishers if each.name == topic)
    listened = (each for node in nodes for each in node.subscriptions if each.name == topic)
    known = (each for each in graph.topics if each.name == topic)
    return tuple(dict.fromkeys(kind for each in (*published, *known, *listened) for kind in each.types))
