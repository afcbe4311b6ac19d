#!/usr/bin/env python3
"""One node file, and the simulated robot beside it where it wants one."""

import shlex

from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription

PACKAGE = "bot_console_robot"


def generate_launch_description():
    """Describe the system."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("program", description="Path of a Python file that makes a node"),
            DeclareLaunchArgument("words", default_value="", description="Its command line, quoted as in a shell"),
            DeclareLaunchArgument("simulator", default_value="true", description="Start the simulated robot as well"),
            DeclareLaunchArgument("world", default_value="indoor", description="World of the simulator"),
            DeclareLaunchArgument("seed", default_value="1", description="Seed of the simulator"),
            Node(
                package=PACKAGE,
                executable="simulator_node",
                name="simulator",
                output="screen",
                parameters=[{"world": LaunchConfiguration("world"), "seed": LaunchConfiguration("seed")}],
                condition=IfCondition(LaunchConfiguration("simulator")),
            ),
            OpaqueFunction(function=make_program),
        ]
    )


def make_program(context):
    """The file, with its words."""
    words = shlex.split(LaunchConfiguration("words").perform(context))
    program = LaunchConfiguration("program").perform(context)
    return [Node(executable=program, output="screen", arguments=words)]
