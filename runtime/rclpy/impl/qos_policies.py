"""The QoS policies, with rmw's numbers."""

from __future__ import annotations

import sys
import warnings
from enum import EnumMeta, IntEnum
from typing import Any

from rclpy.impl.named_enum import NamedIntEnum


class QoSPolicyEnumMeta(EnumMeta):
    """Accepts the deprecated member names of ROS 2 Dashing, with a warning."""

    def __getattr__(cls, name: str) -> Any:
        prefix = cls.__dict__.get("_deprecated_prefix")
        new = name[len(prefix) :] if prefix and name.startswith(prefix) else ""
        if new in cls.__members__:
            warnings.warn(f"{cls.__name__}.{name} is deprecated. Use {cls.__name__}.{new} instead.", stacklevel=2)
            return cls[new]
        raise AttributeError(
            name if sys.version_info < (3, 12) else f"type object {cls.__name__!r} has no attribute {name!r}"
        )


class QoSPolicyEnum(IntEnum, metaclass=QoSPolicyEnumMeta):
    """Base of policies: members can be found by a short, lower-case key."""

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the keys of all members."""
        return [name.lower() for name, _ in cls.__members__.items() if not name.startswith("RMW")]

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        """Return the number of the member with that key; raises `KeyError`."""
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        """The key of this member; raises `AttributeError` if it has none."""
        return self.name.lower()


class HistoryPolicy(QoSPolicyEnum):
    """How many messages are kept."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3


class ReliabilityPolicy(QoSPolicyEnum):
    """Whether lost messages are retransmitted."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class DurabilityPolicy(QoSPolicyEnum):
    """Whether late subscriptions receive earlier messages."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class LivelinessPolicy(QoSPolicyEnum):
    """How a publisher shows that it is alive."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


HistoryPolicy._deprecated_prefix = "RMW_QOS_POLICY_HISTORY_"  # type: ignore[attr-defined] -- set once the class is made
ReliabilityPolicy._deprecated_prefix = "RMW_QOS_POLICY_RELIABILITY_"  # type: ignore[attr-defined] -- set once the class is made
DurabilityPolicy._deprecated_prefix = "RMW_QOS_POLICY_DURABILITY_"  # type: ignore[attr-defined] -- set once the class is made
LivelinessPolicy._deprecated_prefix = "RMW_QOS_POLICY_LIVELINESS_"  # type: ignore[attr-defined] -- set once the class is made


class QoSPolicyKind(IntEnum):
    """Names of policies, as events report them."""

    INVALID = 1 << 0
    DURABILITY = 1 << 1
    DEADLINE = 1 << 2
    LIVELINESS = 1 << 3
    RELIABILITY = 1 << 4
    HISTORY = 1 << 5
    LIFESPAN = 1 << 6
    DEPTH = 1 << 7
    LIVELINESS_LEASE_DURATION = 1 << 8
    AVOID_ROS_NAMESPACE_CONVENTIONS = 1 << 9


def qos_policy_name_from_kind(policy_kind: QoSPolicyKind | int) -> str:
    """Return the name of a policy."""
    return QoSPolicyKind(policy_kind).name


class QoSCompatibility(NamedIntEnum):
    """Outcome of a check of two profiles."""

    OK = 0
    WARNING = 1
    ERROR = 2
