"""How a middleware treats QoS: whether a publisher's profile suits a subscription's, and whether messages expire."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from bot_console.runtime.rmw.qos import Profile

INFINITE = (0, 2**63 - 2, 2**63 - 1)
"""Durations in ns that mean no limit: unspecified, "best available", infinite."""
LATCHING = ("TRANSIENT_LOCAL", "BEST_AVAILABLE")
"""Durabilities with which a publisher keeps messages for late subscriptions."""


def incompatible_policy(offered: Profile, requested: Profile) -> str:
    """Return the name of the incompatible policy, or the last one in rmw's order of several; empty if the profiles
    match.
    """
    worst = ""
    if requested.reliability.name == "RELIABLE" and offered.reliability.name == "BEST_EFFORT":
        worst = "RELIABILITY"
    if requested.durability.name == "TRANSIENT_LOCAL" and offered.durability.name == "VOLATILE":
        worst = "DURABILITY"
    if _is_shorter(requested.deadline.nanoseconds, offered.deadline.nanoseconds):
        worst = "DEADLINE"
    if requested.liveliness.name == "MANUAL_BY_TOPIC" and offered.liveliness.name in ("AUTOMATIC", "SYSTEM_DEFAULT"):
        worst = "LIVELINESS"
    lease = requested.liveliness_lease_duration.nanoseconds, offered.liveliness_lease_duration.nanoseconds
    if _is_shorter(*lease):
        worst = "LIVELINESS"
    return worst


def _always_compatible(offered: Profile, requested: Profile) -> str:
    """Return an empty text: no policy is incompatible in rmw_zenoh, which delivers whatever a publisher offers."""
    return ""


class QosRules(NamedTuple):
    """How a middleware treats QoS policies."""

    identifier: str
    """The name of the middleware that rclpy returns."""
    incompatible_policy: Callable[[Profile, Profile], str]
    """Returns the policy that makes a publisher (first) and a subscription incompatible; empty if they match."""
    enforces_lifespan: bool
    """Whether messages older than their publisher's lifespan are dropped on receipt."""

    def lifespan(self, offered: Profile) -> int | None:
        """How long a publisher's messages are valid, in ns; None for ever."""
        nanoseconds = offered.lifespan.nanoseconds
        return nanoseconds if self.enforces_lifespan and nanoseconds not in INFINITE else None


DDS = QosRules("rmw_bot_console", incompatible_policy, True)
"""The rules of the embedded domain, which are those of the DDS middlewares."""
RMW_ZENOH = QosRules("rmw_zenoh_cpp", _always_compatible, False)
"""The rules of nodes behind a Zenoh router: no two profiles are incompatible, and no message expires in transit."""


def _is_shorter(requested: int, offered: int) -> bool:
    """Whether the requested duration is shorter than the offered one."""
    if requested in INFINITE:
        return False
    return offered in INFINITE or offered > requested


def wants_history(requested: Profile, offers: Sequence[Profile]) -> bool:
    """Whether a subscription gets earlier messages; with "best available", only if all publishers keep them."""
    if requested.durability.name == "BEST_AVAILABLE":
        return all(offer.durability.name in LATCHING for offer in offers)
    return requested.durability.name == "TRANSIENT_LOCAL"
