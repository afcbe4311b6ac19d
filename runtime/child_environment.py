"""The environment of processes started by a launch: `ros2` on the PATH, `rclpy` and all messages importable.

It corresponds to sourcing a ROS installation. Only such processes have it.
"""

from __future__ import annotations

import os
import sys
import sysconfig
import tempfile
import threading
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path

from bot_console.runtime.child_discovery import children_meet
from bot_console.runtime.commands import BIN, COMMAND_VARIABLE, command
from bot_console.runtime.importer import embedded_names, is_installed
from bot_console.runtime.process.scratch import scratch
from bot_console.runtime.workspace.program import source_folders

RANGE_VARIABLE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
"""Not imported from `rmw`: launch, which uses this module, does not depend on the middleware."""

SHIM = '''\
"""Stands in for an embedded package until the embedded runtime is in place, and gives way to it."""

import sys

sys.path.extend(each for each in {folders!r} if each not in sys.path)

from bot_console.runtime.shim import give_way

give_way(__name__)
'''


class ChildEnvironment:
    """Folders of this process for its children: executables, and a shim for each embedded package."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        """Held while the folders are filled: launches of one process may start programs at the same time."""
        self._shimmed: set[str] = set()

    def added_to(self, env: Mapping[str, str]) -> dict[str, str]:
        """Return an environment with the folders first on both paths; one without PATH was not inherited and is
        unchanged.
        """
        if "PATH" not in env:
            return dict(env)
        return {
            **env,
            COMMAND_VARIABLE: command(),
            **({} if children_meet() else {RANGE_VARIABLE: "OFF"}),
            "PATH": _joined([str(BIN / "ros2"), *_venv()], env["PATH"]),
            "PYTHONPATH": _joined([str(self._shims()), *source_folders()], env.get("PYTHONPATH", "")),
        }

    @cached_property
    def _folder(self) -> Path:
        return Path(tempfile.mkdtemp(prefix="child-", dir=scratch()))

    def _shims(self) -> Path:
        """Return the folder of shims, adding one for each package that is new in the workspace."""
        with self._lock:
            folder = self._folder / "python"
            folder.mkdir(exist_ok=True)
            new = [each for each in embedded_names() if each not in self._shimmed]
            for name in new:  # links, because writing so many files would take longer than starting a process
                os.symlink(self._shim, folder / f"{name}.py")
            self._shimmed.update(new)
            return folder

    @cached_property
    def _shim(self) -> Path:
        file = self._folder / "stand_in.py"
        file.write_text(SHIM.format(folders=[str(Path(__file__).absolute().parents[2]), *_dependencies()]))
        return file


def _venv() -> list[str]:
    """Return the folder of `python3` if it was installed for this program alone."""
    return [os.path.dirname(sys.executable)] if sys.prefix != sys.base_prefix else []


def _dependencies() -> list[str]:
    """Return where this package's dependencies are installed: another interpreter may have none of them."""
    return list(dict.fromkeys(sysconfig.get_path(each) for each in ("purelib", "platlib")))


def _joined(first: Iterable[str], rest: str) -> str:
    there = [each for each in rest.split(os.pathsep) if each]
    return os.pathsep.join([*(each for each in first if each not in there), *there])


_environment = ChildEnvironment()


def child_environment(env: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of a process that a launch starts, based on the one given by the launch file.

    It is unchanged for a launch on the machine's own rclpy, whose processes find everything there.
    """
    return _environment.added_to(env) if os.name == "posix" and is_installed() else dict(env)
