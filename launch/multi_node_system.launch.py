#!/usr/bin/env python3
"""Launches all nodes for a tour on which the motion controller leads the robot along the world's waypoints."""

from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution

from launch import LaunchDescription

PACKAGE = "bot_console_robot"


def generate_launch_description():
    """Describe the system."""
    system = PathJoinSubstitution([get_package_share_directory(PACKAGE), "launch", "robot_system.launch.py"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("profile", default_value="warehouse", description="Environment: settings and world"),
            DeclareLaunchArgument(
                "follow_route", default_value="true", description="Drive along the world's waypoints"
            ),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(system),
                launch_arguments={
                    "profile": LaunchConfiguration("profile"),
                    "follow_route": LaunchConfiguration("follow_route"),
                }.items(),
            ),
        ]
    )
