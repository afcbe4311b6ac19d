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
    """The same types as `Time` returns them; they print by name, as upstream's come from the C extension."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3


TimeClockType.__name__ = ClockType.__name__
