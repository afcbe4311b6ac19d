"""`component_container` and its variant with several threads; a component is a Python class here."""

from __future__ import annotations

from launch_ros.component_container import main

__all__ = ["main", "main_mt"]


def main_mt() -> None:
    """Run a container whose callbacks run in several threads."""
    main(threads=None)
