"""A scripted `ros2` command line."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from typing import Any

from bot_console.tui.commanding.completion import live_names
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.command_line import Stream
from bot_console.tui.console.model import ConsoleSnapshot


class FakeCommandLine:
    """Prints the name of one node for every line, and keeps the lines with the requests to the console."""

    def __init__(self, asked: list[tuple[Any, ...]]) -> None:
        self._asked = asked

    def stream(self, line: str) -> Stream | None:
        return None

    def commands(self) -> Sequence[str]:
        return ("node", "topic", "param")

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        before = [*words[:-1]]
        live = live_names(snapshot, ["topic", "list"]) or []
        return done(live if before in (["topic", "echo"], ["topic", "hz"]) else ["echo", "hz", "list"])

    def run(self, line: str) -> Future[str]:
        self._asked.append(("run", line))
        return done("/robot_navigator\n")
