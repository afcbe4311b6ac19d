"""Profiles as graph queries tell them: what the middleware made of them."""

from __future__ import annotations

from typing import Any

from rclpy.duration import Infinite
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

_DURATIONS = ("lifespan", "deadline", "liveliness_lease_duration")
_UNDECIDED = ("SYSTEM_DEFAULT", "BEST_AVAILABLE", "UNKNOWN")


def in_effect(asked: QoSProfile) -> QoSProfile:
    """The profile with the middleware's choice where the program left it open, and unlimited durations as infinite."""
    told = {name: getattr(asked, name) for name in _DURATIONS}
    return QoSProfile(
        history=asked.history,
        depth=asked.depth,
        reliability=_decided(asked.reliability, ReliabilityPolicy.RELIABLE),
        durability=_decided(asked.durability, DurabilityPolicy.VOLATILE),
        liveliness=_decided(asked.liveliness, LivelinessPolicy.AUTOMATIC),
        avoid_ros_namespace_conventions=asked.avoid_ros_namespace_conventions,
        **{name: value if value.nanoseconds else Infinite for name, value in told.items()},
    )


def _decided(policy: Any, default: Any) -> Any:
    return default if policy.name in _UNDECIDED else policy
