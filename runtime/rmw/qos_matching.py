"""Whether a publisher's QoS satisfies a subscription's."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.runtime.rmw.qos import Profile

INFINITE = (0, 2**63 - 2, 2**63 - 1)
"""Durations in ns that mean no limit: unspecified, "best available", infinite."""
LATCHING = ("TRANSIENT_LOCAL", "BEST_AVAILABLE")
"""Durabilities with which a publisher keeps messages for late subscriptions."""


def incompatible_policy(offered: Profile, requested: Profile) -> str:
    """Return the name of the incompatible policy, of several the last in rmw's order; empty if the profiles match."""
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
    """Whether the requested duration is shorter than the offered one."""
    if requested in INFINITE:
        return False
    return offered in INFINITE or offered > requested


def wants_history(requested: Profile, offers: Sequence[Profile]) -> bool:
    """Whether a subscription gets earlier messages; with "best available", only if all publishers keep them."""
    if requested.durability.name == "BEST_AVAILABLE":
        return all(offer.durability.name in LATCHING for offer in offers)
    return requested.durability.name == "TRANSIENT_LOCAL"
