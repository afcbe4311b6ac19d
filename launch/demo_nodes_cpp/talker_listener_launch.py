"""Launches a talker and a listener."""

from launch_ros.actions import Node

from launch import LaunchDescription


def generate_launch_description():
    """Describe the system."""
    names = ("talker", "listener")
    return LaunchDescription([Node(package="demo_nodes_cpp", executable=name, output="screen") for name in names])
