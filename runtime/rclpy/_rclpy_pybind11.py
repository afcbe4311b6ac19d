"""Exceptions that upstream defines in its C extension, in the module from which programs import them."""

from __future__ import annotations

import builtins
from enum import IntEnum


class RCLError(RuntimeError):
    """The ROS client library rejected a call."""


class RCLInvalidROSArgsError(RCLError):
    """The ROS part of a node's command line cannot be parsed."""


class UnknownROSArgsError(RuntimeError):
    """The ROS part of a command line has unknown arguments; the message lists them."""


class NodeNameNonExistentError(RCLError):
    """The graph contains no node with that name."""


class UnsupportedEventTypeError(RCLError):
    """The middleware does not support this event."""


class NotImplementedError(builtins.NotImplementedError):
    """The middleware does not implement this."""


class InvalidHandle(RuntimeError):
    """An entity was used after it was destroyed."""


class RMWError(RuntimeError):
    """The middleware rejected a call, or received bytes that are not a message."""


class rmw_qos_policy_kind_t(IntEnum):  # noqa: N801 -- upstream's name
    """The policies of events, with the middleware's names; the values are those of `rclpy.qos.QoSPolicyKind`."""

    RMW_QOS_POLICY_INVALID = 1 << 0
    RMW_QOS_POLICY_DURABILITY = 1 << 1
    RMW_QOS_POLICY_DEADLINE = 1 << 2
    RMW_QOS_POLICY_LIVELINESS = 1 << 3
    RMW_QOS_POLICY_RELIABILITY = 1 << 4
    RMW_QOS_POLICY_HISTORY = 1 << 5
    RMW_QOS_POLICY_LIFESPAN = 1 << 6
    RMW_QOS_POLICY_DEPTH = 1 << 7
    RMW_QOS_POLICY_LIVELINESS_LEASE_DURATION = 1 << 8
    RMW_QOS_POLICY_AVOID_ROS_NAMESPACE_CONVENTIONS = 1 << 9

    def __str__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    def __format__(self, format_spec: str) -> str:
        return format(str(self), format_spec)
