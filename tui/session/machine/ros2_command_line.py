"""Runs `ros2 ...` lines with the machine's own `ros2`, or with ours if only an `rclpy` is installed."""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from concurrent.futures import Future

from bot_console.tui.console.command_gate import done
from bot_console.tui.console.command_line import Stream
from bot_console.tui.console.command_line_limits import HELP, LINE_TIMEOUT_S, goes_on, interrupted, starts_nodes
from bot_console.tui.console.in_background import in_background
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.running_line import RunningLine

COMMANDS = (
    "action",
    "bag",
    "component",
    "control",
    "daemon",
    "doctor",
    "interface",
    "launch",
    "lifecycle",
    "multicast",
    "node",
    "param",
    "pkg",
    "run",
    "security",
    "service",
    "topic",
    "wtf",
    "colcon",
)
OWN_COMMANDS = ("action", "interface", "lifecycle", "node", "param", "service", "topic")
"""The commands that our `ros2` provides without the packages of an installed ROS 2."""
INTERRUPT_TIMEOUT_S = 3.0
"""Seconds that a command has to end after the interrupt."""


class _StreamedCommand(RunningLine):
    """A command in a separate process, with the last lines that it has printed."""

    def __init__(self, words: Sequence[str]) -> None:
        super().__init__()
        self._process = _start(words)
        threading.Thread(target=self._read, name="ros2", daemon=True).start()

    def _read(self) -> None:
        with self._process.stdout or open(os.devnull, "rb") as printed:
            for line in printed:
                self.append(line.decode("utf-8", "replace"))
        self._process.wait()
        self.end()

    def stop(self) -> None:
        """Interrupt it, as Ctrl-C does."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)


class MachineCommandLine:
    """Runs each line as a process; implements `tui.console.command_line.CommandLine`."""

    def commands(self) -> Sequence[str]:
        """The commands that a `ros2` of any release may have, or else those of ours."""
        return COMMANDS if shutil.which("ros2") else OWN_COMMANDS

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """Completions from the running system; only the machine's own shell knows others."""
        if len(words) < 2:
            found: Sequence[str] = self.commands()
        elif words[0] in ("node", "param", "lifecycle"):
            found = [each.name for each in snapshot.graph.nodes]
        else:
            ends = snapshot.graph.services if words[0] == "service" else snapshot.graph.topics
            found = [each.name for each in ends]
        return done(sorted(each for each in found if each.startswith(words[-1])) if words else ())

    def stream(self, line: str) -> Stream | None:
        """Start a line that keeps printing; returns None for any other line, or if there is no such command."""
        try:
            words = _words(line)
        except ValueError:
            return None
        program = _program(words)
        return _StreamedCommand(program) if program and (goes_on(words[1:]) or _starts(words[1:])) else None

    def run(self, line: str) -> Future[str]:
        """Run a line in the background; the result is its output, or a `ValueError` if a quotation mark is
        unmatched.
        """
        return in_background(lambda: printed_by(line), "ros2")


def printed_by(line: str, limit: float = LINE_TIMEOUT_S) -> str:
    """Run a line; returns its output, including errors."""
    words = _words(line)
    program = _program(words)
    if not program:
        return _missing(words)
    process = _start(program)
    note = ""
    for timeout_s, end in ((limit, lambda: process.send_signal(signal.SIGINT)), (INTERRUPT_TIMEOUT_S, process.kill)):
        try:
            printed, _ = process.communicate(timeout=timeout_s)
            break
        except subprocess.TimeoutExpired:
            end()
            note = interrupted(limit)
    else:
        printed, _ = process.communicate()
    return printed.decode("utf-8", "replace") + note


def _words(line: str) -> list[str]:
    words = shlex.split(line)
    return words if words[:1] in (["ros2"], ["colcon"]) else ["ros2", *words]


def _starts(words: Sequence[str]) -> bool:
    """Whether a line (without `ros2`) starts nodes, or records or plays a bag: in a terminal, it runs until Ctrl-C."""
    bag = list(words[:2]) in (["bag", "play"], ["bag", "record"]) and not any(each in HELP for each in words)
    return bag or starts_nodes(words)


def _program(words: Sequence[str]) -> Sequence[str]:
    """The command line of a process that runs these words; empty if neither the machine nor we provide it."""
    if shutil.which(words[0]):
        return words
    ours = words[0] == "ros2" and words[1:] and words[1] in OWN_COMMANDS
    return [sys.executable, "-m", "bot_console.tui.session.machine.own_ros2", *words[1:]] if ours else ()


def _missing(words: Sequence[str]) -> str:
    missing = f"there is no command '{words[0]}' on this machine's PATH: is its ROS 2 sourced?"
    return f"{missing} Without it, there are {', '.join(OWN_COMMANDS)}." if words[0] == "ros2" else missing


def _start(words: Sequence[str]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        words,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},  # otherwise output to a pipe would only appear at the end
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
