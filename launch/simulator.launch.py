#!/usr/bin/env python3
"""The simulated robot alone, for nodes that are started elsewhere."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription

PACKAGE = "bot_console_robot"


def generate_launch_description():
    """Describe the system."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("world", default_value="indoor", description="World of the simulator"),
            DeclareLaunchArgument("seed", default_value="1", description="Seed of the simulator"),
            Node(
                package=PACKAGE,
                executable="simulator_node",
                name="simulator",
                output="screen",
                parameters=[{"world": LaunchConfiguration("world"), "seed": LaunchConfiguration("seed")}],
            ),
        ]
    )
