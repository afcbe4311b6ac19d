"""The module from which older programs import `InvalidHandle`, which now belongs to `rclpy.exceptions`."""

from rclpy.exceptions import InvalidHandle

__all__ = ["InvalidHandle"]
