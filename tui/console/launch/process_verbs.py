"""The methods by which every launcher controls a single process."""

from __future__ import annotations

from abc import ABC, abstractmethod
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer


class ProcessVerbs(ABC):
    """The methods of `Launcher` that control one process, all implemented by `_want`."""

    def start(self, key: str) -> Future[Answer]:
        """Start a process that has ended; answered when it runs."""
        return self._want("start", key)

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does; answered when it has ended."""
        return self._want("stop", key)

    def kill(self, key: str) -> Future[Answer]:
        """Kill a process, as SIGKILL does; launch respawns it if its launch file says so."""
        return self._want("kill", key)

    def restart(self, key: str) -> Future[Answer]:
        """Stop, then start; answered when it runs again."""
        return self._want("restart", key)

    def restart_on_failure(self, key: str) -> Future[Answer]:
        """Restart a process whenever it fails, as the settings say."""
        return self._want("restart_on_failure", key)

    def leave_ended(self, key: str) -> Future[Answer]:
        """Do not restart a process that has ended by itself."""
        return self._want("leave_ended", key)

    @abstractmethod
    def _want(self, verb: str, key: str, /) -> Future[Answer]:
        """Apply the verb to the process with that key."""
