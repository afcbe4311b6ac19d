"""The C extension under the name by which programs import it, for `RCLError` and its other exceptions."""

from rclpy import _rclpy_pybind11 as rclpy_implementation

__all__ = ["rclpy_implementation"]
