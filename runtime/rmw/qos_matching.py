"""Whether a publisher's offer satisfies what a subscription asks for."""

from __future__ import annotations

from typing import Any

INFINITE = 0
"""A duration of zero stands for no limit."""


def incompatible_policy(offered: Any, requested: Any) -> str:
    """The name of the policy in which two profiles do not fit, as rmw tells the last one; empty when they fit."""
    worst = ""
    if requested.reliability.name == "RELIABLE" and offered.reliability.name == "BEST_EFFORT":
        worst = "RELIABILITY"
    if requested.durability.name == "TRANSIENT_LOCAL" and offered.durability.name == "VOLATILE":
        worst = "DURABILITY"
    if _shorter(requested.deadline.nanoseconds, offered.deadline.nanoseconds):
        worst = "DEADLINE"
    if requested.liveliness.name == "MANUAL_BY_TOPIC" and offered.liveliness.name in ("AUTOMATIC", "SYSTEM_DEFAULT"):
        worst = "LIVELINESS"
    lease = requested.liveliness_lease_duration.nanoseconds, offered.liveliness_lease_duration.nanoseconds
    if _shorter(*lease):
        worst = "LIVELINESS"
    return worst


def _shorter(requested: int, offered: int) -> bool:
    """Whether less is asked for than is offered; zero is for ever."""
    if requested == INFINITE:
        return False
    return offered == INFINITE or offered > requested
