"""The QoS profiles that graph queries report: those in effect in the middleware."""

from __future__ import annotations

from functools import lru_cache
from typing import TypeVar

from bot_console.runtime.rmw.qos import Period, Policy, Profile
from rclpy.duration import Duration, Infinite
from rclpy.impl.qos_policies import QoSPolicyEnum
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

_P = TypeVar("_P", bound=QoSPolicyEnum)
_UNDECIDED = ("SYSTEM_DEFAULT", "BEST_AVAILABLE", "UNKNOWN")


def in_effect(asked: Profile) -> QoSProfile:
    """The profile with the middleware's defaults where the program left it open, and unlimited durations as infinite.

    Each caller gets its own object, which it may change. For a profile received over the wire it is computed once.
    """
    return copied(_of_wire(asked)) if isinstance(asked, tuple) else _in_effect(asked)


@lru_cache(256)  # a graph of thousands of endpoints has only a few profiles
def _of_wire(asked: Profile) -> QoSProfile:
    return _in_effect(asked)


def _in_effect(asked: Profile) -> QoSProfile:
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


def copied(profile: QoSProfile) -> QoSProfile:
    """A copy of a profile; durations are shared, as they are immutable."""
    copy = QoSProfile.__new__(QoSProfile)
    for slot in QoSProfile.__slots__:
        setattr(copy, slot, getattr(profile, slot))
    return copy


def _decided(policy: Policy, default: _P) -> _P:
    return default if policy.name in _UNDECIDED else type(default)[policy.name]


def _limited(period: Period) -> Duration:
    return Duration(nanoseconds=period.nanoseconds) if period.nanoseconds else Infinite
