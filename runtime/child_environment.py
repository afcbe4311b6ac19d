"""What a process started by a launch finds, whatever starts it: `ros2` on its PATH, `rclpy` and all messages to import.

It is what a sourced ROS installation gives. Only the environment of such a process has it.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path

from bot_console.runtime.importer import embedded_names, install
from bot_console.runtime.workspace.program import source_folders

ROS2 = """\
#!/bin/sh
exec '{python}' -c 'import sys
if sys.path[:1] == [""]:
    sys.path.pop(0)
from bot_console.runtime.child_environment import ros2
sys.exit(ros2())' "$@"
"""
"""The working directory is not looked into, as no installed command does."""

STAND_IN = '''\
"""Stands in for `{name}` until the embedded runtime is in place, and gives way to it."""

import sys

if {parent!r} not in sys.path:
    sys.path.append({parent!r})

from bot_console.runtime.importer import give_way

give_way(__name__)
'''


class ChildEnvironment:
    """Folders of this process for its children: executables, and a stand-in for each embedded package."""

    def __init__(self) -> None:
        self._stood_in: set[str] = set()

    def added_to(self, env: Mapping[str, str]) -> dict[str, str]:
        """An environment with the folders first on both paths; one without PATH was not inherited, and stays."""
        if "PATH" not in env:
            return dict(env)
        return {
            **env,
            "PATH": _joined([str(self._executables), *_venv()], env["PATH"]),
            "PYTHONPATH": _joined([str(self._stand_ins()), *source_folders()], env.get("PYTHONPATH", "")),
        }

    @cached_property
    def _folder(self) -> Path:
        self._held = tempfile.TemporaryDirectory(prefix="bot-console-child-")
        return Path(self._held.name)

    @cached_property
    def _executables(self) -> Path:
        folder = self._folder / "bin"
        folder.mkdir()
        ros2 = folder / "ros2"
        ros2.write_text(ROS2.format(python=sys.executable))
        ros2.chmod(0o755)
        return folder

    def _stand_ins(self) -> Path:
        """The folder of stand-ins; a package that has come to the workspace since the last process gets one now."""
        folder = self._folder / "python"
        folder.mkdir(exist_ok=True)
        parent = str(Path(__file__).absolute().parents[2])
        for name in embedded_names():
            if name not in self._stood_in:
                (folder / f"{name}.py").write_text(STAND_IN.format(name=name, parent=parent))
                self._stood_in.add(name)
        return folder


def _venv() -> list[str]:
    """The folder of `python3`, where that has been installed for this program alone."""
    return [os.path.dirname(sys.executable)] if sys.prefix != sys.base_prefix else []


def _joined(first: Iterable[str], rest: str) -> str:
    there = [each for each in rest.split(os.pathsep) if each]
    return os.pathsep.join([*(each for each in first if each not in there), *there])


_environment = ChildEnvironment()


def child_environment(env: Mapping[str, str]) -> dict[str, str]:
    """The environment of a process that a launch starts, made from the one that the launch file describes."""
    return _environment.added_to(env) if os.name == "posix" else dict(env)


def ros2() -> int:
    """The command `ros2` of such a process."""
    install()
    from ros2cli.command_line import main

    return main()
