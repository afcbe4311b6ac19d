"""The port for launching: passes requests on to a launcher unless the console is read-only."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate, done
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import LaunchArgument


class GatedLauncher:
    """A launcher behind the gate. It can start processes before the console itself has connected."""

    def __init__(self, gate: Gate, launcher: Launcher) -> None:
        self._gate = gate
        self._launcher = launcher

    def _order(self, order: Callable[[str], Future[Answer]], key: str) -> Future[Answer]:
        return done(Answer(False, self._gate.read_only)) if self._gate.read_only else order(key)

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file."""
        return self._order(lambda path: self._launcher.launch(path, arguments), path)

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments that a launch file declares. It is a program, so a read-only console does not run it."""
        if self._gate.read_only:
            raise ValueError(self._gate.read_only)
        return self._launcher.arguments(path)

    def files(self) -> Sequence[str]:
        """The launch files of the workspace, to choose from."""
        return () if self._gate.read_only else self._launcher.files()

    def start(self, key: str) -> Future[Answer]:
        """Start a process that has ended."""
        return self._order(self._launcher.start, key)

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process."""
        return self._order(self._launcher.stop, key)

    def kill(self, key: str) -> Future[Answer]:
        """Kill a process at once."""
        return self._order(self._launcher.kill, key)

    def restart(self, key: str) -> Future[Answer]:
        """Stop a process, then start it again."""
        return self._order(self._launcher.restart, key)

    def restart_on_failure(self, key: str) -> Future[Answer]:
        """From now on, restart a process whenever it fails."""
        return self._order(self._launcher.restart_on_failure, key)

    def leave_ended(self, key: str) -> Future[Answer]:
        """No longer restart a process when it fails."""
        return self._order(self._launcher.leave_ended, key)
