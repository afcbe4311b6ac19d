"""The port for running `ros2 ...` lines. Standard library only."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from typing import Protocol

from bot_console.tui.console.model import ConsoleSnapshot


class Stream(Protocol):
    """A running command line that prints until it is stopped."""

    def lines(self) -> Sequence[str]:
        """The last lines printed; the same object until there are more."""
        ...

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        ...

    def stop(self) -> None:
        """Interrupt it, as Ctrl-C does."""
        ...


class CommandLine(Protocol):
    """Runs `ros2 ...` lines."""

    def run(self, line: str) -> Future[str]:
        """Run a line; the result is its output."""
        ...

    def stream(self, line: str) -> Stream | None:
        """Start a line that keeps printing, such as `ros2 topic hz /odom`; returns None for any other line, without
        running it.
        """
        ...

    def commands(self) -> Sequence[str]:
        """The commands that a line may begin with, without `ros2` itself."""
        ...

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """Completions of the last word (empty, or the start of an option), with names of the nodes and topics in
        `snapshot`.
        """
        ...
