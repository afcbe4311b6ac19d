"""The port for `ros2 ...` lines: a read-only console runs those that change nothing. Standard library only."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from concurrent.futures import Future

from bot_console.tui.console.command_gate import Gate, done
from bot_console.tui.console.command_line import CommandLine, Stream
from bot_console.tui.console.model import ConsoleSnapshot

NO_LINES = "no ros2 command line is available here"
READING: Mapping[str, frozenset[str]] = {
    "action": frozenset(("info", "list", "type")),
    "component": frozenset(("list", "types")),
    "interface": frozenset(("list", "package", "packages", "proto", "show")),
    "lifecycle": frozenset(("get", "list", "nodes")),
    "node": frozenset(("info", "list")),
    "param": frozenset(("describe", "get", "list")),
    "pkg": frozenset(("executables", "list", "prefix", "xml")),
    "service": frozenset(("echo", "find", "info", "list", "type")),
    "topic": frozenset(("bw", "delay", "echo", "find", "hz", "info", "list", "type")),
}
"""Lines that change nothing: the subcommands that only read, by command."""


class GatedCommandLine:
    """A command line behind the gate."""

    def __init__(self, gate: Gate, lines: CommandLine | None) -> None:
        """If `lines` is None, no line can be run."""
        self._gate = gate
        self._lines = lines

    def stream(self, line: str) -> Stream | None:
        """Start a line that keeps printing; None for any other, and for one that a read-only console refuses."""
        if self._lines is None or (self._gate.read_only and _may_change(line)):
            return None
        return self._lines.stream(line)

    def commands(self) -> Sequence[str]:
        """The commands that a line may begin with."""
        return self._lines.commands() if self._lines else ()

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """Completions of the last word."""
        return self._lines.complete(words, snapshot) if self._lines else done(())

    def run(self, line: str) -> Future[str]:
        """Run a line; a read-only console prints a refusal for one that would change something."""
        if self._lines is None:
            return done(NO_LINES)
        if self._gate.read_only and _may_change(line):
            return done(f"refused: {self._gate.read_only}")
        return self._lines.run(line)


def _may_change(line: str) -> bool:
    try:
        words = shlex.split(line)
    except ValueError:
        return False  # such a line is not run, only its syntax error is printed
    words = words[1:] if words[:1] == ["ros2"] else words
    return len(words) != 1 and not (words and words[1] in READING.get(words[0], ()))
