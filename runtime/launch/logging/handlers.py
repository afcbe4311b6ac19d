"""Handlers of the records of a launch."""

from launch.logging.config import ScreenHandler

__all__ = ["ScreenHandler"]
