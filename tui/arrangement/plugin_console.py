"""The console as panes of other packages see it: its ports and, for one release, the ports' former names."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from operator import attrgetter
from typing import Any

from bot_console.tui.console.protocol import Console

FORMER_NAMES: Mapping[str, str] = {
    "set_parameters": "parameters.set",
    "set_all": "parameters.set_all",
    "undo": "parameters.undo",
    "redo": "parameters.redo",
    "changes": "parameters.changes",
    "save_parameters": "parameters.save",
    "log": "logs.record",
    "matching_logs": "logs.matching",
    "view_logs": "logs.view",
    "open_log": "logs.open",
    "clear_logs": "logs.clear",
    "set_logger_level": "logs.set_level",
    "logger_levels": "logs.levels",
    "watch": "plots.watch",
    "unwatch": "plots.unwatch",
    "samples": "plots.samples",
    "plot_time": "plots.time",
    "plottable": "plots.plottable",
    "all_stop": "drive.stop",
    "hold_early": "drive.hold_early",
    "settle_early": "drive.settle_early",
    "release": "drive.release",
    "choose_robot": "drive.choose",
    "steer": "drive.steer",
    "pose_at": "drive.pose_at",
    "profile_differences": "profiles.differences",
    "apply_profile": "profiles.apply",
    "fetch_profile": "profiles.fetch",
    "open_profile": "profiles.open",
    "save_profile": "profiles.save",
    "rename_profile": "profiles.rename",
    "delete_profile": "profiles.delete",
    "call": "topics.call_service",
    "traffic": "topics",
    "recording": "bags",
}


class PluginConsole:
    """A console that also has the names of the last release; using one of them warns."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self.drive = _CallableDrive(console)

    def __getattr__(self, name: str) -> Any:
        now = FORMER_NAMES.get(name)
        if now is None:
            return getattr(self._console, name)
        _warn(f"console.{name} is called console.{now} from now on")
        return attrgetter(now)(self._console)


class _CallableDrive:
    """The port for the robot, which can still be called as the method that it was before."""

    def __init__(self, console: Console) -> None:
        self._console = console

    def __call__(self, linear: float, angular: float) -> None:
        _warn("console.drive(...) is called console.drive.move(...) from now on")
        self._console.drive.move(linear, angular)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._console.drive, name)


def _warn(text: str) -> None:
    warnings.warn(text, FutureWarning, stacklevel=3)
