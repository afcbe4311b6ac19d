"""Descriptions of executables."""

from launch.descriptions.executable import Executable

__all__ = ["Executable"]
