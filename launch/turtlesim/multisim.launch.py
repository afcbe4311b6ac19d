"""Launches two turtlesim nodes, each in its own namespace."""

from launch_ros.actions import Node

from launch import LaunchDescription


def generate_launch_description():
    """Describe the system."""
    return LaunchDescription(
        [
            Node(namespace=namespace, package="turtlesim", executable="turtlesim_node", output="screen")
            for namespace in ("turtlesim1", "turtlesim2")
        ]
    )
