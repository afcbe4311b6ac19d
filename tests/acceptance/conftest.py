"""Imports modules that programs of stepped runs would otherwise import.

A program that computes for a second of wall time without waiting counts as busy, and time goes on without it; on a
loaded machine the first import of these modules takes that long.
"""

import importlib

for _module in (
    "numpy",
    "yaml",
    "example_interfaces.action",
    "lifecycle_msgs.srv",
    "rclpy.action",
    "rclpy.executors",
    "rclpy.lifecycle",
    "rclpy.node",
    "ros2cli.command_line",
    "ros2cli.verbs.action",
    "ros2cli.verbs.lifecycle",
):
    importlib.import_module(_module)
