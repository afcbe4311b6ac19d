"""Kinds of clocks."""

from enum import IntEnum


class ClockType(IntEnum):
    """The clock types of rcl with their numbers."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
