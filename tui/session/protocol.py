"""The protocols of a session. Standard library only."""

from __future__ import annotations

from typing import Protocol

from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import LaunchInfo


class ClosableLauncher(Launcher, Protocol):
    """A launcher with its state, which can be closed; a console uses it, and a launch host serves it."""

    def info(self) -> LaunchInfo:
        """The state of the launches; the same object until something changes."""
        ...

    def close(self) -> None:
        """End everything that it has started; a second call does nothing."""
        ...
