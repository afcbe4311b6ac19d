"""The discovery range, from the environment."""

from __future__ import annotations

import os

RANGE_VARIABLE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
RANGES = frozenset({"", "OFF", "LOCALHOST", "SUBNET", "SYSTEM_DEFAULT"})
"""The valid values. Only OFF makes a difference: nothing reaches beyond this machine unless it is asked to."""


def is_in_range() -> bool:
    """Whether the environment lets the processes of this machine discover each other."""
    return os.environ.get(RANGE_VARIABLE, "") != "OFF"


def why_range_is_ignored() -> str:
    """Return rcl's message for an unknown value, such as `off`; empty for a valid one."""
    value = os.environ.get(RANGE_VARIABLE, "")
    known = value in RANGES
    return "" if known else f"Invalid value '{value}' specified for '{RANGE_VARIABLE}', assuming localhost only"
