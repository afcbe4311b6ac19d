"""Exceptions that upstream defines in its C extension, under the module name that programs import them from."""

from __future__ import annotations

import builtins


class RCLError(RuntimeError):
    """The ROS client library refused a call."""


class RCLInvalidROSArgsError(RCLError):
    """The command line of a node has a ROS part that cannot be parsed."""


class UnknownROSArgsError(RuntimeError):
    """The ROS part of a command line has words that mean nothing; the message is their list."""


class NodeNameNonExistentError(RCLError):
    """No node of that name is in the graph."""


class UnsupportedEventTypeError(RCLError):
    """The middleware has no such event."""


class NotImplementedError(builtins.NotImplementedError):
    """The middleware cannot do this."""


class InvalidHandle(RuntimeError):
    """Something was used after it was destroyed."""


class RMWError(RuntimeError):
    """The middleware refused a call, or got bytes that are no message."""
