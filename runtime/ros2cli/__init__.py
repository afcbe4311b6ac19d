"""The `ros2` command line over the public rclpy API: verbs, output and exit codes are those of ROS 2 Jazzy."""

from ros2cli.command_line import main

__all__ = ["main"]
