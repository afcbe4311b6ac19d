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


def mismatched(info: GraphInfo) -> dict[str, list[tuple[str, str, str]]]:
    """Publisher, subscription and reason for each pair between which no messages pass, by topic."""
    offers: dict[str, list[tuple[str, str]]] = {}
    wants: dict[str, list[tuple[str, str]]] = {}
    for node in info.nodes:
        for ends, found in ((node.publishers, offers), (node.subscriptions, wants)):
            for each in ends:
                found.setdefault(each.name, []).append((node.name, each.qos))
    result: dict[str, list[tuple[str, str, str]]] = {}
    for topic, publishers in offers.items():
        pairs = ((a, b, mismatch(offered, wanted)) for a, offered in publishers for b, wanted in wants.get(topic, ()))
        wrong = [each for each in pairs if each[2]]
        if wrong:
            result[topic] = wrong
    return result
