#!/usr/bin/env python3
"""Launches one node: a Python file, or an executable of a package."""

import os
import shlex

from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription


def generate_launch_description():
    """Describe the system."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "program", description="Path of a Python file that contains a node, or the name of an executable"
            ),
            DeclareLaunchArgument("package", default_value="", description="Package that contains the executable"),
            DeclareLaunchArgument(
                "words", default_value="", description="Command-line arguments, quoted as in a shell"
            ),
            OpaqueFunction(function=make_program),
        ]
    )


def make_program(context):
    """Make the action that starts the node with its arguments."""
    words = shlex.split(LaunchConfiguration("words").perform(context))
    program = LaunchConfiguration("program").perform(context)
    options = {"package": name} if (name := LaunchConfiguration("package").perform(context)) else {}
    if program.endswith(".py"):  # The file need not be executable.
        options.update(prefix="python3", exec_name=os.path.basename(program))
    return [Node(executable=program, output="screen", arguments=words, **options)]
