"""`ros2 ...` lines that are typed in the console."""

from __future__ import annotations

import shlex
import sys
import threading
from collections.abc import Sequence
from concurrent.futures import Future

from bot_console.runtime.process import NodeProcess
from bot_console.tui.cli.started_lines import launched_by
from bot_console.tui.cli.verbs.colcon import answers
from bot_console.tui.console.lines import RunningLine, goes_on
from bot_console.tui.console.protocol import Launcher, Stream

LINE_LIMIT = 15.0
"""Seconds after which a line that does not end by itself, and was not expected to go on, is interrupted."""
STARTING = 30.0
"""Seconds after which what a line launches is not waited for any more: the Launch pane tells the rest."""


class Ros2CommandLine:
    """Runs each line in a node process of its own; `tui.console.protocol.CommandLine`."""

    def __init__(self, launcher: Launcher | None = None) -> None:
        """`launcher` starts what `ros2 run` and `ros2 launch` name: it stays, and stands in the Launch pane."""
        self._launcher = launcher

    def run(self, line: str) -> Future[str]:
        """Run a line beside the caller; what it printed, or the `ValueError` of a quotation mark without its twin."""
        outcome: Future[str] = Future()

        def work() -> None:
            try:
                outcome.set_result(self._done(line))
            except Exception as error:  # the border of the thread
                outcome.set_exception(error)

        threading.Thread(target=work, name="ros2", daemon=True).start()
        return outcome

    def stream(self, line: str) -> Stream | None:
        """Begin a line that goes on by itself; None for any other."""
        try:
            words = _words(line)
        except ValueError:
            return None
        return _Streamed(words) if goes_on(words) else None

    def _done(self, line: str) -> str:
        words = _words(line)
        if words[:1] == ["colcon"]:
            return "\n".join(answers(words[1:]))
        wanted = launched_by(words) if self._launcher is not None else None
        if wanted is None or self._launcher is None:
            return _printed_by(words)
        if wanted.problem:
            return wanted.problem
        answer = self._launcher.launch(wanted.file, wanted.arguments).result(STARTING)
        return f"{wanted.name} runs: it stands in the Launch pane, which ends it" if answer.ok else answer.text


class _Streamed:
    """A line in a node process, and the last of what it has printed."""

    def __init__(self, words: Sequence[str]) -> None:
        self._printed = RunningLine()
        self._process = _start(words, self._printed)
        self._process.on_exit(lambda process: self._printed.end())

    def lines(self) -> Sequence[str]:
        """The last lines; the same object until there are more."""
        return self._printed.lines()

    @property
    def ended(self) -> bool:
        """Whether nothing more comes."""
        return self._printed.ended

    def stop(self) -> None:
        """Interrupt it, as Ctrl-C does."""
        threading.Thread(target=self._process.stop, name="ros2", daemon=True).start()


def _words(line: str) -> list[str]:
    words = shlex.split(line)
    return words[1:] if words[:1] == ["ros2"] else words


def _start(words: Sequence[str], printed: RunningLine | list[str]) -> NodeProcess:
    from ros2cli.command_line import main

    process = NodeProcess("ros2")
    process.start(lambda: sys.exit(main(words)), argv=["ros2", *words], stdout=printed.append, stderr=printed.append)
    return process


def _printed_by(words: Sequence[str]) -> str:
    printed: list[str] = []
    process = _start(words, printed)
    if process.wait(LINE_LIMIT) is None:
        process.stop()
    return "".join(printed)
