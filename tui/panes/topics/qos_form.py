"""The form for the QoS of a subscription, and why no messages may arrive with that QoS. Pure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from bot_console.tui.console.model import GraphInfo, LaunchArgument
from bot_console.tui.console.topics.port import MAX_DEPTH, RequestedQos

OFFERED = "as_offered"
CHOICES = {
    "reliability": (OFFERED, "reliable", "best_effort"),
    "durability": (OFFERED, "volatile", "transient_local"),
    "history": (OFFERED, "keep_last", "keep_all"),
}
ABOUT = {
    "reliability": "A reliable subscription receives nothing from a best-effort publisher",
    "durability": "A transient-local subscription also gets earlier messages, but only from transient-local publishers",
    "history": "Whether only the newest messages are kept, or all of them",
}
DEPTH = "depth"


def qos_fields(now: RequestedQos) -> Sequence[LaunchArgument]:
    """The fields of the form."""
    policies = [
        LaunchArgument(name, ABOUT[name], getattr(now, name) or OFFERED, choices) for name, choices in CHOICES.items()
    ]
    depth = LaunchArgument(DEPTH, "How many messages are kept until they are shown", str(now.depth or OFFERED))
    return (*policies, depth)


def qos_problem(changed: Mapping[str, str]) -> str:
    """The problem with the typed values; empty if there is none."""
    depth = changed.get(DEPTH, OFFERED)
    if depth == OFFERED or (depth.isascii() and depth.isdigit() and len(depth) < 8 and 1 <= int(depth) <= MAX_DEPTH):
        return ""
    return f"depth must be a whole number from 1 to {MAX_DEPTH}, or {OFFERED}"


def changed_qos(now: RequestedQos, changed: Mapping[str, str]) -> RequestedQos:
    """Apply the changed values of the form to a QoS."""
    values = {name: "" if text == OFFERED else text for name, text in changed.items()}
    depth = values.pop(DEPTH, str(now.depth))
    return replace(now, **values, depth=int(depth or 0))


def silence_reason(asked: RequestedQos, topic: str, info: GraphInfo | None) -> str:
    """Why no messages arrive, if publishers offer less than was requested; otherwise empty."""
    offers = [end.qos for node in (info.nodes if info else ()) for end in node.publishers if end.name == topic]
    wanted = {"best effort": asked.reliability == "reliable", "volatile": asked.durability == "transient_local"}
    for less, matters in wanted.items():
        count = sum(less in each for each in offers)
        if matters and count:
            return f": {count} of {len(offers)} publishers offer {less}, so nothing arrives from them"
    return ""
