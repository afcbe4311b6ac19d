"""The environment of processes that a program of the runtime starts: `ros2` on the PATH, `rclpy` importable.

It corresponds to sourcing a ROS installation.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping

from bot_console.runtime.children.child_discovery import RANGE_VARIABLE, children_meet
from bot_console.runtime.importer import is_installed
from bot_console.runtime.ros_commands import BIN, COMMAND_VARIABLE, command
from bot_console.runtime.shim_folder import shim_folder
from bot_console.runtime.workspace.discover import SOURCED_VARIABLE, workspace
from bot_console.runtime.workspace.program import source_folders

EMBEDDED = {"BOT_CONSOLE_RUNTIME": "embedded"}
"""Makes the shims stand for the embedded runtime even beside a real rclpy, so that a child meets its parent's nodes."""


def child_environment(env: Mapping[str, str]) -> dict[str, str]:
    """Return the environment for a child process: `env`, with our folders first on both paths.

    It is unchanged for a launch on the machine's own rclpy, where processes find everything, and if PATH is missing, as
    it was then not inherited.
    """
    if os.name != "posix" or not is_installed() or "PATH" not in env:
        return dict(env)
    return {
        **env,
        **EMBEDDED,
        COMMAND_VARIABLE: command(),
        SOURCED_VARIABLE: _joined(map(str, workspace().folders), env.get(SOURCED_VARIABLE, "")),
        **({} if children_meet() else {RANGE_VARIABLE: "OFF"}),
        "PATH": _joined([str(BIN / "ros2"), *_venv()], env["PATH"]),
        "PYTHONPATH": _python_path(env.get("PYTHONPATH", "")),
    }


def _python_path(given: str) -> str:
    """Return the path with the shims first, wherever a shell has put them, as it may also contain a real rclpy."""
    shims = str(shim_folder())
    rest = (each for each in given.split(os.pathsep) if each != shims)
    return _joined([shims, *source_folders()], os.pathsep.join(rest))


def _venv() -> list[str]:
    """Return the folder of `python3` if it was installed only for this program."""
    return [os.path.dirname(sys.executable)] if sys.prefix != sys.base_prefix else []


def _joined(first: Iterable[str], rest: str) -> str:
    there = [each for each in rest.split(os.pathsep) if each]
    return os.pathsep.join([*(each for each in first if each not in there), *there])
