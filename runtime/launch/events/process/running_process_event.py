"""Base class of events of a process."""

from __future__ import annotations

from typing import Any

from launch.event import Event


class RunningProcessEvent(Event):
    """Something that has happened in or to a process."""

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self,
        *,
        action: object,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
        **_more: object,
    ) -> None:
        self.__action = action
        self.__name = name
        self.__cmd = cmd
        self.__cwd = cwd
        self.__env = env
        self.__pid = pid

    @property
    def action(self) -> Any:
        """The action that runs the process."""
        return self.__action

    @property
    def execute_process_action(self) -> Any:
        """The action, by its old name."""
        return self.__action

    @property
    def process_name(self) -> str:
        """The process's label, such as `talker-1`."""
        return self.__name

    @property
    def cmd(self) -> list[str]:
        """Its command line."""
        return self.__cmd

    @property
    def cwd(self) -> str | None:
        """Its working directory; None for the launch's own."""
        return self.__cwd

    @property
    def env(self) -> dict[str, str] | None:
        """Its environment; None for the launch's own."""
        return self.__env

    @property
    def pid(self) -> int:
        """Its process id."""
        return self.__pid
