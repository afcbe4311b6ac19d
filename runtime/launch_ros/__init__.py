"""The embedded launch_ros: the public API of ROS 2 Jazzy's `launch_ros`."""

from launch_ros import actions, descriptions, event_handlers, events, parameter_descriptions, substitutions, utilities
from launch_ros.parameters_type import SomeParameters
from launch_ros.remap_rule_type import SomeRemapRules

__all__ = [
    "SomeParameters",
    "SomeRemapRules",
    "actions",
    "descriptions",
    "event_handlers",
    "events",
    "parameter_descriptions",
    "substitutions",
    "utilities",
]
