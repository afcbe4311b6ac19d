"""Shared by the `bag` verbs: argument types, a node, and the folder of a new bag."""

from __future__ import annotations

import argparse
import importlib
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bot_console.tui.console.own_context import WITHOUT_LOG_FILE
from bot_console.tui.session.embedded.reaching import reach_system

if TYPE_CHECKING:
    from bot_console.tui.console.bags.port import GenericTypes
    from rclpy.node import Node


def named_folder(text: str) -> Path:
    """Argument type: a path that is not empty."""
    if not text:
        raise argparse.ArgumentTypeError("the name of the bag is empty")
    return Path(text)


def existing_file(text: str) -> Path:
    """Argument type: the path of an existing file."""
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"there is no file {text}")
    return path


def report_unused(given: argparse.Namespace, unused: Mapping[str, str]) -> None:
    """Print which of the given options are ignored, and why."""
    for name, why in unused.items():
        if getattr(given, name, None) not in (None, False):
            print(f"--{name.replace('_', '-')} is ignored: {why}", file=sys.stderr)


def new_folder(near: Path | None = None) -> Path:
    """The path of a new folder: `near`, or `rosbag2_` and the time in the current one; numbered if that exists."""
    base = near or Path(f"rosbag2_{time.strftime('%Y_%m_%d-%H_%M_%S')}")
    found, number = base, 0
    while found.exists():
        number += 1
        found = base.with_name(f"{base.name}_{number}")
    return found


def make_node(name: str, *, machine: bool = False) -> Any:
    """Create a node in the domain or behind the robot's router; if that fails, print why and return None.

    With `machine`, create a node of the machine's ROS 2.
    """
    made = join_domain(name, machine=machine)
    if isinstance(made, str):
        print(made, file=sys.stderr)
        return None
    return made


def join_domain(name: str = "rosbag2_player", *, machine: bool = False) -> Any:
    """Create a node in the domain or behind the robot's router; if that fails, return a text that says why.

    With `machine`, create a node of the machine's ROS 2.
    """
    import rclpy

    unreachable = "" if machine else reach_system()
    if unreachable:
        return unreachable
    rclpy.init(args=WITHOUT_LOG_FILE)
    return rclpy.create_node(name, start_parameter_services=False)


def generic_types(*, machine: bool) -> GenericTypes | None:
    """Generic classes for message types without a definition here; None for the machine's ROS 2, which has none."""
    from bot_console.tui.session.embedded.hooks import DomainTypes

    return None if machine else DomainTypes()


def service_types() -> Any:
    """The module of rosbag2's services; None if the ROS 2 in use does not have it."""
    try:
        return importlib.import_module("rosbag2_interfaces.srv")
    except ImportError:
        return None


def spin(node: Node, duration: float | None, stopped: threading.Event | None = None) -> None:
    """Spin a node for `duration` seconds, or until `stopped` is set or the program is asked to end."""
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

    end = None if duration is None else time.monotonic() + duration
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not (stopped is not None and stopped.is_set()) and (end is None or time.monotonic() < end):
            executor.spin_once(timeout_sec=0.1)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
