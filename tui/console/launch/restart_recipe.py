"""Restarts a process that launch has started before, with a new action of the public launch API.

An action can be executed only once, so a second start needs a new one, made from the event of the first start. Event
handlers of the launch file that wait for the original action do not recognise the new one; `on_exit` is kept if it
contains no process.
"""

from __future__ import annotations

import os
import re
import shlex
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bot_console.tui.console.model import Program

if TYPE_CHECKING:
    from launch.events.process import ProcessStarted

    from launch import LaunchContext


@dataclass(frozen=True)
class Recipe:
    """The data needed to restart a process; `package` is None if the path of the program suffices."""

    command: list[str]
    label: str
    options: dict[str, Any]
    prefix: str
    is_node: bool
    package: str | None

    @property
    def program(self) -> Program:
        """The program as it is shown to people and written to files, without its environment."""
        command = tuple(map(str, self.command[len(shlex.split(self.prefix)) :]))
        respawn, delay = bool(self.options.get("respawn")), self.options.get("respawn_delay")
        folder = self.options.get("cwd") or ""
        return Program(command, self.package or "", self.prefix, str(folder), respawn, delay)

    def action(self) -> Any:
        """A new action that runs the same program."""
        from launch.actions import ExecuteProcess
        from launch_ros.actions import Node

        if not self.is_node:
            return ExecuteProcess(cmd=self.command, name=self.label, **self.options)
        program, *arguments = self.command[len(shlex.split(self.prefix)) :]
        arguments = arguments[:-1] if arguments[-1:] == ["--ros-args"] else arguments  # a Node action adds it itself
        where = {"executable": program}
        if self.package is not None:
            where = {"package": self.package, "executable": os.path.basename(program)}
        return Node(**where, arguments=arguments, prefix=self.prefix, exec_name=self.label, **self.options)


def recipe(event: ProcessStarted, context: LaunchContext) -> Recipe:
    """Extract the data with which a process was started from its `ProcessStarted` event."""
    from launch_ros.actions import Node

    action = event.action
    is_node = isinstance(action, Node)
    options: dict[str, Any] = {
        "cwd": event.cwd,
        "env": event.env,
        "shell": action.shell,
        "output": getattr(action, "output", "log"),
        "emulate_tty": action.emulate_tty,
        "sigterm_timeout": _text(context, getattr(action, "sigterm_timeout", "5"), "5"),
        "sigkill_timeout": _text(context, getattr(action, "sigkill_timeout", "5"), "5"),
        "on_exit": _on_exit(action),
        **_respawn(action),
    }
    prefix = _text(context, action.process_description.prefix, "") or ""
    package = _text(context, action.node_package, None) if is_node else None
    label = re.sub(r"-\d+$", "", event.process_name)
    return Recipe(list(event.cmd), label, options, prefix, is_node, package)


def _text(context: LaunchContext, substitutions: Any, otherwise: str | None) -> str | None:
    from launch.substitutions import SubstitutionFailure
    from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

    if substitutions is None:
        return None
    try:
        return perform_substitutions(context, normalize_to_list_of_substitutions(substitutions))
    except SubstitutionFailure:  # needs a launch configuration that only its own scope has
        return otherwise


def _on_exit(action: Any) -> Any:
    from launch.actions import ExecuteLocal

    wanted: Any = getattr(action, "on_exit", None)
    several: Any = wanted if type(wanted) in (list, tuple) else (wanted,)
    return None if any(isinstance(each, ExecuteLocal) for each in several) else wanted


def _respawn(action: Any) -> dict[str, Any]:
    """The respawn options of an action, if launch respawns its process."""
    wanted = getattr(action, "respawn", None)
    return {"respawn": wanted, "respawn_delay": getattr(action, "respawn_delay", None)} if wanted else {}
