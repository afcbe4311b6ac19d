"""Where older programs import `InvalidHandle` from; it belongs to `rclpy.exceptions` now."""

from rclpy.exceptions import InvalidHandle

__all__ = ["InvalidHandle"]
