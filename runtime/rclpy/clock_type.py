"""Kinds of clocks."""

from enum import IntEnum

from rclpy.impl.named_enum import NamedIntEnum


class ClockType(IntEnum):
    """The clock types of rcl with their numbers."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3


class TimeClockType(NamedIntEnum):
    """The same as times have them, which print by name: upstream's are of the C extension."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3


TimeClockType.__name__ = ClockType.__name__
