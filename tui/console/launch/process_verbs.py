"""The methods with which every launcher controls a single process."""

from __future__ import annotations

from abc import ABC, abstractmethod
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer


class ProcessVerbs(ABC):
    """The methods of `Launcher` that control one process, all implemented by `_request`."""

    def start(self, key: str) -> Future[Answer]:
        """Start a process that has ended; the answer comes when it runs."""
        return self._request("start", key)

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does; the answer comes when it has ended."""
        return self._request("stop", key)

    def kill(self, key: str) -> Future[Answer]:
        """Kill a process with SIGKILL; launch respawns it if its launch file says so."""
        return self._request("kill", key)

    def restart(self, key: str) -> Future[Answer]:
        """Stop and start a process; the answer comes when it runs again."""
        return self._request("restart", key)

    def restart_on_failure(self, key: str) -> Future[Answer]:
        """From now on, restart a process whenever it fails, as the settings say."""
        return self._request("restart_on_failure", key)

    def leave_ended(self, key: str) -> Future[Answer]:
        """No longer restart a process when it fails."""
        return self._request("leave_ended", key)

    @abstractmethod
    def _request(self, verb: str, key: str, /) -> Future[Answer]:
        """Apply a verb to the process with this key."""
