"""What every launcher can be asked for one process."""

from __future__ import annotations

from abc import ABC, abstractmethod
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer


class AskedForProcesses(ABC):
    """The four methods of `Launcher` that steer one process, as one."""

    def start(self, key: str) -> Future[Answer]:
        """Start an ended process again; the answer comes when it runs."""
        return self._want("start", key)

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does; the answer comes when it has ended."""
        return self._want("stop", key)

    def kill(self, key: str) -> Future[Answer]:
        """End a process at once, as SIGKILL does; launch starts it again where its launch file says so."""
        return self._want("kill", key)

    def restart(self, key: str) -> Future[Answer]:
        """Stop, then start; the answer comes when it runs again."""
        return self._want("restart", key)

    @abstractmethod
    def _want(self, verb: str, key: str, /) -> Future[Answer]:
        """Do what the verb says to the process of that key."""
