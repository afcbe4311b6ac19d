"""Runs `ros2 ...` lines that are typed in the console."""

from __future__ import annotations

import shlex
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future

from bot_console.runtime.process import NodeProcess
from bot_console.tui.cli.completion import candidates
from bot_console.tui.cli.launch_lines import parse_launch_line
from bot_console.tui.cli.verbs.colcon import answers
from bot_console.tui.commanding.completion import live_names
from bot_console.tui.console.command_line import Stream
from bot_console.tui.console.command_line_limits import LINE_TIMEOUT_S, goes_on, interrupted, starts_nodes
from bot_console.tui.console.in_background import in_background
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.running_line import RunningLine
from bot_console.tui.learn.command_log import append_record, log_path, record_command

START_TIMEOUT_S = 30.0
"""Seconds to wait for the start of what a line launches; after that, the Launch pane shows the rest."""


class Ros2CommandLine:
    """Runs each line in its own node process; implements `tui.console.command_line.CommandLine`."""

    def __init__(self, launcher: Launcher | None = None, no_launch: str = "") -> None:
        """`launcher` starts what `ros2 run` and `ros2 launch` name, which keeps running and is listed in the Launch
        pane. `no_launch` is the reason if nothing can be started in the console's system.
        """
        self._launcher = launcher
        self._no_launch = no_launch
        self._known: dict[tuple[str, ...], list[str]] = {}
        """The output of verbs that does not change while the console runs, such as packages and types."""

    def run(self, line: str) -> Future[str]:
        """Run a line in the background; the result is its output, or a `ValueError` if it cannot be run."""
        return in_background(lambda: self._recorded(line), "ros2")

    def stream(self, line: str) -> Stream | None:
        """Start a line that keeps printing; returns None for any other line."""
        try:
            words = _words(line)
        except ValueError:
            return None
        return _StreamedCommand(words) if goes_on(words) else None

    def commands(self) -> Sequence[str]:
        """The commands that a line may begin with."""
        from ros2cli.command_line import COMMANDS

        return [*COMMANDS, "colcon"]

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """Completions of the last word, found in the background."""
        names = _CompletionNames(snapshot, self._known)
        return in_background(lambda: candidates(words, names), "ros2")

    def _recorded(self, line: str) -> str:
        words = _words(line)
        log, text, code = log_path(words), "", 1
        if log:
            append_record(log, words, None)
        try:
            text, code = self._done(words)
        finally:
            if log:
                append_record(log, words, code, text)
        return text

    def _done(self, words: Sequence[str]) -> tuple[str, int]:
        """Run a line; returns its output and exit code."""
        if words[:1] == ["colcon"]:
            return "\n".join(answers(words[1:])), 0
        if self._no_launch and starts_nodes(words):
            raise ValueError(self._no_launch)
        wanted = parse_launch_line(words) if self._launcher is not None else None
        if wanted is None or self._launcher is None:
            return _printed_by(words)
        if wanted.problem:
            raise ValueError(wanted.problem)
        answer = self._launcher.launch(wanted.file, wanted.arguments).result(START_TIMEOUT_S)
        if not answer.ok:
            raise ValueError(answer.text)
        return f"{wanted.name} runs, and is listed in the Launch pane, where x ends it", 0


class _CompletionNames:
    """Names for completion: those of running things from the console's snapshot, all others as verbs print them."""

    def __init__(self, snapshot: ConsoleSnapshot, known: dict[tuple[str, ...], list[str]]) -> None:
        self._snapshot = snapshot
        self._known = known

    def lines_of(self, *words: str) -> list[str]:
        """The lines that a verb prints, which are cached."""
        if words not in self._known:
            self._known[words] = [each.strip() for each in _printed_by(words)[0].splitlines()]
        return self._known[words]

    def live_lines_of(self, *words: str) -> list[str]:
        """The same for verbs that query running things; not cached."""
        found = live_names(self._snapshot, words)
        return found if found is not None else [each.strip() for each in _printed_by(words)[0].splitlines()]


class _StreamedCommand(RunningLine):
    """A command in a node process, with the last lines that it has printed; recorded for an open lesson."""

    def __init__(self, words: Sequence[str]) -> None:
        super().__init__()
        self._process = _start(words, self, _recorded)
        self._process.on_exit(lambda process: self.end())

    def stop(self) -> None:
        """Interrupt it, as Ctrl-C does."""
        threading.Thread(target=self._process.stop, name="ros2", daemon=True).start()


def _words(line: str) -> list[str]:
    words = shlex.split(line)
    return words[1:] if words[:1] == ["ros2"] else words


def _recorded(words: Sequence[str]) -> int:
    with record_command(words) as ended:
        return ended(_run(words))


def _run(words: Sequence[str]) -> int:
    from ros2cli.command_line import main

    return main(words)


def _start(
    words: Sequence[str], printed: RunningLine | list[str], run: Callable[[Sequence[str]], int] = _run
) -> NodeProcess:
    process = NodeProcess("ros2")
    process.start(lambda: sys.exit(run(words)), argv=["ros2", *words], stdout=printed.append, stderr=printed.append)
    return process


def _printed_by(words: Sequence[str]) -> tuple[str, int]:
    """Run a line in a node process; returns its output and exit code, that of an interrupt if it has timed out."""
    printed: list[str] = []
    process = _start(words, printed)
    code = process.wait(LINE_TIMEOUT_S)
    if code is None:
        process.stop()
        printed.append(interrupted(LINE_TIMEOUT_S))
    return "".join(printed), 128 + signal.SIGINT if code is None else code
