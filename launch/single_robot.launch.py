#!/usr/bin/env python3
"""Launches the smallest system: the navigator drives the simulated robot directly, without other nodes in between."""

from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node

from launch import LaunchDescription

PACKAGE = "bot_console_robot"


def generate_launch_description():
    """Describe the system."""
    config_file = LaunchConfiguration("config_file")
    default = PathJoinSubstitution([get_package_share_directory(PACKAGE), "config", "indoor_config.yaml"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("config_file", default_value=default, description="Path to robot configuration file"),
            Node(
                package=PACKAGE,
                executable="simulator_node",
                name="simulator",
                output="screen",
                parameters=[config_file],
            ),
            Node(
                package=PACKAGE,
                executable="robot_node",
                name="robot_navigator",
                output="screen",
                parameters=[config_file],
            ),
        ]
    )
