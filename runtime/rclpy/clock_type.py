"""Kinds of clocks."""

from rclpy.impl.named_enum import NamedIntEnum


class ClockType(NamedIntEnum):
    """The clock types of rcl with their numbers."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
