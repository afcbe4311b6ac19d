"""Why two profiles do not fit, or may not fit, in the words of rmw_dds_common."""

from __future__ import annotations

from typing import Any

from rclpy.impl.qos_policies import DurabilityPolicy, LivelinessPolicy, ReliabilityPolicy

UNSURE = ("SYSTEM_DEFAULT", "UNKNOWN")


def errors(publisher: Any, subscription: Any) -> list[str]:
    """What keeps messages from flowing."""
    found: list[str] = []
    reliability = publisher.reliability, subscription.reliability
    if reliability == (ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE):
        found.append("Best effort publisher and reliable subscription")
    durability = publisher.durability, subscription.durability
    if durability == (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL):
        found.append("Volatile publisher and transient local subscription")
    found += _duration(publisher.deadline, subscription.deadline, "deadline", "deadline")
    liveliness = publisher.liveliness, subscription.liveliness
    if liveliness == (LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC):
        found.append("Publisher's liveliness is automatic and subscription's is manual by topic")
    lease = publisher.liveliness_lease_duration, subscription.liveliness_lease_duration
    found += _duration(*lease, "liveliness lease duration", "liveliness lease duration")
    return found


def _duration(offered: Any, requested: Any, short: str, long: str) -> list[str]:
    if not requested.nanoseconds:
        return []
    if not offered.nanoseconds:
        return [f"Subscription has a {short}, but publisher does not"]
    if requested.nanoseconds < offered.nanoseconds:
        return [f"Subscription {long} is less than publisher {long}"]
    return []


def warnings(publisher: Any, subscription: Any) -> list[str]:
    """What may keep messages from flowing, as a default of the middleware decides."""
    found = _unsure("reliability", publisher.reliability, subscription.reliability, "RELIABLE", "BEST_EFFORT")
    found += _unsure("durability", publisher.durability, subscription.durability, "TRANSIENT_LOCAL", "VOLATILE")
    found += _unsure("liveliness", publisher.liveliness, subscription.liveliness, "MANUAL_BY_TOPIC", "AUTOMATIC")
    return found


def _unsure(what: str, offered: Any, requested: Any, strict: str, loose: str) -> list[str]:
    if offered.name in UNSURE and requested.name in UNSURE:
        return [f"Publisher {what} is {offered.short_key} and subscription {what} is {requested.short_key}"]
    if requested.name == strict and offered.name in UNSURE:
        return [f"{_words(strict)} subscription, but publisher {what} is {offered.short_key}"]
    if offered.name == loose and requested.name in UNSURE:
        return [f"{_words(loose)} publisher, but subscription {what} is {requested.short_key}"]
    return []


def _words(name: str) -> str:
    return name.replace("_", " ").capitalize()
