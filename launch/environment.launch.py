#!/usr/bin/env python3
"""Launches the system with the parameters and the world of one environment."""

from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, LogInfo
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution

from launch import LaunchDescription

PACKAGE = "bot_console_robot"
ENVIRONMENTS = ["indoor", "outdoor", "warehouse", "competition"]


def generate_launch_description():
    """Describe the system."""
    environment = LaunchConfiguration("environment")
    system = PathJoinSubstitution([get_package_share_directory(PACKAGE), "launch", "robot_system.launch.py"])
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "environment", default_value="indoor", choices=ENVIRONMENTS, description="Where the robot drives"
            ),
            LogInfo(msg=["Environment: ", environment]),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(system), launch_arguments={"profile": environment}.items()
            ),
        ]
    )
