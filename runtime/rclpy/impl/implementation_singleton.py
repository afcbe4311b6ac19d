"""The C extension under the name that programs import, for `RCLError` and its other exceptions."""

from rclpy import _rclpy_pybind11 as rclpy_implementation

__all__ = ["rclpy_implementation"]
