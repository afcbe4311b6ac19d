"""The protocols of a session. Standard library only."""

from __future__ import annotations

from typing import Protocol

from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import LaunchInfo


class ClosableLauncher(Launcher, Protocol):
    """A launcher with its state and its end: what a console holds, and what a launch host serves."""

    def info(self) -> LaunchInfo:
        """The newest state; the same object until something changes."""
        ...

    def close(self) -> None:
        """End what it has started; a second call does nothing."""
        ...
