"""`FakeLauncher`: a scripted launcher that implements the `Launcher` protocol without launching anything."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.launch.process import LaunchedProcess, Order
from bot_console.tui.console.model import LaunchArgument

from fakes.console import CLOSED, FakeConsole


class FakeLauncher:
    """A launcher that keeps the requests it received; if it has a console, it applies them to the processes shown
    there."""

    def __init__(
        self,
        arguments: Sequence[LaunchArgument] = (),
        files: Sequence[str] = (),
        console: FakeConsole | None = None,
    ) -> None:
        self.asked: list[tuple[Any, ...]] = []
        self.declared = arguments
        self.known = files
        self.broken = ""
        self.closed = False
        self._console = console
        self._processes: dict[str, LaunchedProcess] = {}

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        self.asked.append(("launch", path, dict(arguments)))
        why = CLOSED if self.closed else self.broken
        if self._console and not self.closed:
            info = self._console.current.launch
            self._console.change(launch=replace(info, files=(*info.files, path), problem=why))
            if not why:
                self._add(Path(path).name)
        return done(Answer(not why, why))

    def _add(self, title: str) -> None:
        key = f"waiter@{len(self._processes)}"
        process = self._processes[key] = LaunchedProcess(key, "waiter-1", (title,))
        process.started("waiter-1", 4100)
        self._show()

    def _show(self) -> None:
        if self._console:
            processes = tuple(each.info for each in self._processes.values())
            self._console.change(launch=replace(self._console.current.launch, processes=processes))

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        if self.broken:
            raise ValueError(self.broken)
        return self.declared

    def files(self) -> Sequence[str]:
        return self.known

    def start(self, key: str) -> Future[Answer]:
        return self._asked("start", key)

    def stop(self, key: str) -> Future[Answer]:
        return self._asked("stop", key)

    def kill(self, key: str) -> Future[Answer]:
        return self._asked("kill", key)

    def restart(self, key: str) -> Future[Answer]:
        return self._asked("restart", key)

    def restart_on_failure(self, key: str) -> Future[Answer]:
        return self._asked("restart_on_failure", key)

    def leave_ended(self, key: str) -> Future[Answer]:
        return self._asked("leave_ended", key)

    def _asked(self, verb: str, key: str) -> Future[Answer]:
        self.asked.append((verb, key))
        if self._console is None:
            return done(Answer(True))
        process = self._processes.get(key)
        if self.closed or process is None:
            return done(Answer(False, CLOSED if self.closed else f"there is no process {key}"))
        order, outcome = process.want(verb)
        if order in (Order.SHUT_DOWN, Order.KILL):
            order = process.exited(-9 if order is Order.KILL else 0, respawns=False)
        if order is Order.START:
            process.started(process.info.label, (process.info.pid or 4100) + 1)
        self._show()
        return outcome

    def close(self) -> None:
        self.closed = True
        for process in self._processes.values():
            if process.alive:
                process.exit_requested()
                process.exited(0, respawns=False)
        self._show()
