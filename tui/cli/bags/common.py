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

from bot_console.tui.session.embedded.reaching import reach_system

if TYPE_CHECKING:
    from bot_console.tui.console.bags.port import GenericTypes
    from rclpy.node import Node


def named_folder(text: str) -> Path:
    """A path that is not empty; raises `ArgumentTypeError`."""
    if not text:
        raise argparse.ArgumentTypeError("the name of the bag is empty")
    return Path(text)


def existing_file(text: str) -> Path:
    """A file that exists; raises `ArgumentTypeError`."""
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"there is no file {text}")
    return path


def report_unused(given: argparse.Namespace, unused: Mapping[str, str]) -> None:
    """Say which options were given that change nothing here, and why."""
    for name, why in unused.items():
        if getattr(given, name, None) not in (None, False):
            print(f"--{name.replace('_', '-')} is ignored: {why}", file=sys.stderr)


def new_folder(near: Path | None = None) -> Path:
    """A folder that does not exist: the given one or, with the time in its name, one here; numbered if necessary."""
    base = near or Path(f"rosbag2_{time.strftime('%Y_%m_%d-%H_%M_%S')}")
    found, number = base, 0
    while found.exists():
        number += 1
        found = base.with_name(f"{base.name}_{number}")
    return found


def make_node(name: str, *, machine: bool = False) -> Any:
    """A node in the domain, or behind the robot's router; None, after printing why, if neither can be reached.

    With `machine`, a node of the machine's ROS 2.
    """
    made = join_domain(name, machine=machine)
    if isinstance(made, str):
        print(made, file=sys.stderr)
        return None
    return made


def join_domain(name: str = "rosbag2_player", *, machine: bool = False) -> Any:
    """A node in the domain, or behind the robot's router; a text that says why if neither can be reached.

    With `machine`, a node of the machine's ROS 2.
    """
    import rclpy

    unreachable = "" if machine else reach_system()
    if unreachable:
        return unreachable
    rclpy.init(args=[])
    return rclpy.create_node(name, start_parameter_services=False)


def generic_types(*, machine: bool) -> GenericTypes | None:
    """Classes for messages of types without a definition here; None for the machine's ROS 2, which takes none."""
    from bot_console.tui.session.embedded.hooks import DomainTypes

    return None if machine else DomainTypes()


def service_types() -> Any:
    """The services of rosbag2; None where a ROS 2 without them is used."""
    try:
        return importlib.import_module("rosbag2_interfaces.srv")
    except ImportError:
        return None


def spin(node: Node, duration: float | None, stopped: threading.Event | None = None) -> None:
    """Spin until the time (s) is up, or until it is stopped or the program is asked to end."""
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

    end = None if duration is None else time.monotonic() + duration
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not (stopped is not None and stopped.is_set()) and (end is None or time.monotonic() < end):
            executor.spin_once(timeout_sec=0.1)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
