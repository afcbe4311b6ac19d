"""Descriptions of what is executed."""

from launch.descriptions.executable import Executable

__all__ = ["Executable"]
