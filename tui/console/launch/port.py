"""The port for launch files and processes, as panes start and end them. Standard library only."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import LaunchArgument


class Launcher(Protocol):
    """The processes that launch files have started; their state is in `ConsoleSnapshot.launch`."""

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file."""
        ...

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments that a launch file declares; raises `ValueError` with file and line if it cannot be read.

        A launch file is a program and may take a while, so this method may be called from any thread.
        """
        ...

    def files(self) -> Sequence[str]:
        """The launch files of the workspace, to choose from."""
        ...

    def start(self, key: str) -> Future[Answer]:
        """Start a process that has ended."""
        ...

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does: SIGINT first, then the launch's escalation."""
        ...

    def kill(self, key: str) -> Future[Answer]:
        """Kill a process at once."""
        ...

    def restart(self, key: str) -> Future[Answer]:
        """Stop a process, then start it again."""
        ...

    def restart_on_failure(self, key: str) -> Future[Answer]:
        """From now on, restart a process when it fails: as often and with the growing delays that the settings say."""
        ...

    def leave_ended(self, key: str) -> Future[Answer]:
        """No longer restart a process when it fails."""
        ...
