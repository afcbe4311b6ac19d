"""Whether an offered QoS satisfies a requested one, from the short texts of the graph. Standard library only."""

from __future__ import annotations

from bot_console.tui.console.model import GraphInfo


def mismatch(offered: str, requested: str) -> str:
    """Why no messages pass from a publisher to a subscription, such as `best effort to reliable`; else empty."""
    if requested.startswith("reliable") and offered.startswith("best effort"):
        return "best effort to reliable"
    if "transient local" in requested and "volatile" in offered:
        return "volatile to transient local"
    return ""


def mismatches(info: GraphInfo, topic: str) -> list[tuple[str, str, str]]:
    """Publisher, subscription and reason for each pair on a topic between which no messages pass."""
    publishers = [(node.name, each.qos) for node in info.nodes for each in node.publishers if each.name == topic]
    subscribers = [(node.name, each.qos) for node in info.nodes for each in node.subscriptions if each.name == topic]
    pairs = ((a, b, mismatch(offered, wanted)) for a, offered in publishers for b, wanted in subscribers)
    return [each for each in pairs if each[2]]
