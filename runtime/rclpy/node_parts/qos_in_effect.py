"""Profiles as graph queries tell them: what the middleware made of them."""

from __future__ import annotations

from typing import TypeVar

from bot_console.runtime.rmw.qos import Period, Policy, Profile
from rclpy.duration import Duration, Infinite
from rclpy.impl.qos_policies import QoSPolicyEnum
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

_P = TypeVar("_P", bound=QoSPolicyEnum)
_UNDECIDED = ("SYSTEM_DEFAULT", "BEST_AVAILABLE", "UNKNOWN")


def in_effect(asked: Profile) -> QoSProfile:
    """The profile with the middleware's choice where the program left it open, and unlimited durations as infinite."""
    return QoSProfile(
        history=HistoryPolicy[asked.history.name],
        depth=asked.depth,
        reliability=_decided(asked.reliability, ReliabilityPolicy.RELIABLE),
        durability=_decided(asked.durability, DurabilityPolicy.VOLATILE),
        liveliness=_decided(asked.liveliness, LivelinessPolicy.AUTOMATIC),
        lifespan=_limited(asked.lifespan),
        deadline=_limited(asked.deadline),
        liveliness_lease_duration=_limited(asked.liveliness_lease_duration),
        avoid_ros_namespace_conventions=isinstance(asked, QoSProfile) and asked.avoid_ros_namespace_conventions,
    )


def _decided(policy: Policy, default: _P) -> _P:
    return default if policy.name in _UNDECIDED else type(default)[policy.name]


def _limited(period: Period) -> Duration:
    return Duration(nanoseconds=period.nanoseconds) if period.nanoseconds else Infinite
