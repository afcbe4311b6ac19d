"""The `ros2` command line over the public rclpy API: verbs, output and exit codes as ROS 2 Jazzy gives them."""

from ros2cli.command_line import main

__all__ = ["main"]
