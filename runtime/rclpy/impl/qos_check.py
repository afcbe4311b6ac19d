"""Why two profiles are or may be incompatible, in the words of rmw_dds_common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.impl.qos_policies import DurabilityPolicy, LivelinessPolicy, ReliabilityPolicy

if TYPE_CHECKING:
    from rclpy.impl.any_clock import Nanoseconds

UNSURE = ("SYSTEM_DEFAULT", "UNKNOWN")
_MISSPELT = {"durability": "durabilty"}
"""Words that rmw_dds_common misspells."""


def errors(publisher: Any, subscription: Any) -> list[str]:
    """Return the reasons why two profiles are incompatible."""
    found: list[str] = []
    reliability = publisher.reliability, subscription.reliability
    if reliability == (ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE):
        found.append("Best effort publisher and reliable subscription")
    durability = publisher.durability, subscription.durability
    if durability == (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL):
        found.append("Volatile publisher and transient local subscription")
    found += _duration(publisher.deadline, subscription.deadline, "deadline", "publisher deadline")
    liveliness = publisher.liveliness, subscription.liveliness
    if liveliness == (LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC):
        found.append("Publisher's liveliness is automatic and subscription's is manual by topic")
    lease = publisher.liveliness_lease_duration, subscription.liveliness_lease_duration
    found += _duration(*lease, "liveliness lease duration", "publisher")
    return found


def _duration(offered: Nanoseconds, requested: Nanoseconds, what: str, other: str) -> list[str]:
    if not requested.nanoseconds:
        return []
    if not offered.nanoseconds:
        return [f"Subscription has a {what}, but publisher does not"]
    if requested.nanoseconds < offered.nanoseconds:
        return [f"Subscription {what} is less than {other}"]
    return []


def warnings(publisher: Any, subscription: Any) -> list[str]:
    """Return the reasons why two profiles may be incompatible, depending on a default of the middleware."""
    found = _unsure("reliability", publisher.reliability, subscription.reliability, "RELIABLE", "BEST_EFFORT")
    found += _unsure("durability", publisher.durability, subscription.durability, "TRANSIENT_LOCAL", "VOLATILE")
    found += _unsure("liveliness", publisher.liveliness, subscription.liveliness, "MANUAL_BY_TOPIC", "AUTOMATIC")
    return found


def _unsure(what: str, offered: Any, requested: Any, strict: str, loose: str) -> list[str]:
    gives, wants = offered.short_key, requested.short_key
    if offered.name in UNSURE and requested.name in UNSURE:
        return [f"Publisher {_MISSPELT.get(what, what)} is {gives} and subscription {what} is {wants}"]
    if requested.name == strict and offered.name in UNSURE:
        if what == "liveliness":
            return [f"Subscription's liveliness is {_words(strict).lower()}, but publisher's is {gives}"]
        return [f"{_words(strict)} subscription, but publisher is {gives}"]
    if offered.name == loose and requested.name in UNSURE:
        if what == "liveliness":
            return [f"Publisher's liveliness is {_words(loose).lower()}, but subscription's is {wants}"]
        return [f"{_words(loose)} publisher, but subscription is {wants}"]
    return []


def _words(name: str) -> str:
    return name.replace("_", " ").capitalize()
