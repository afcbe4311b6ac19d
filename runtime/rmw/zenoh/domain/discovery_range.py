"""The discovery range, from the environment."""

from __future__ import annotations

import os

RANGE_VARIABLE = "ROS_AUTOMATIC_DISCOVERY_RANGE"


def is_in_range() -> bool:
    """Whether the environment lets the processes of this machine discover each other."""
    return os.environ.get(RANGE_VARIABLE, "").upper() != "OFF"
