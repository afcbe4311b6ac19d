"""Launches a turtle that follows the frame of another one, which `turtle_teleop_key` drives."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription

PACKAGE = "turtle_tf2_py"


def generate_launch_description():
    """Describe the system."""
    broadcasters = [
        Node(
            package=PACKAGE,
            executable="turtle_tf2_broadcaster",
            name=f"broadcaster{number}",
            parameters=[{"turtlename": f"turtle{number}"}],
        )
        for number in (1, 2)
    ]
    return LaunchDescription(
        [
            DeclareLaunchArgument("target_frame", default_value="turtle1", description="Frame to follow"),
            Node(package="turtlesim", executable="turtlesim_node", name="sim"),
            *broadcasters,
            Node(
                package=PACKAGE,
                executable="turtle_tf2_listener",
                name="listener",
                parameters=[{"target_frame": LaunchConfiguration("target_frame")}],
            ),
        ]
    )
