"""Systems of node processes in stepped time: programs, commands, and the output of both."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from bot_console.runtime.process import NodeProcess, SteppedTime, file_program, stepped

LONG = 120.0
"""Virtual seconds that a command which ends by itself may take."""

STALL = 30.0
"""Wall-clock seconds that a program may compute or import before the run goes on without it."""


@dataclass
class Program:
    """A running or ended program with its output."""

    process: NodeProcess
    output: list[tuple[str, str]] = field(default_factory=list)

    @property
    def stdout(self) -> str:
        """Everything it wrote to stdout."""
        return "".join(text for stream, text in self.output if stream == "stdout")

    @property
    def stderr(self) -> str:
        """Everything it wrote to stderr."""
        return "".join(text for stream, text in self.output if stream == "stderr")

    @property
    def exit(self) -> int | None:
        """Its exit code; None while it runs."""
        return self.process.exit_code


class System:
    """Node processes of one stepped run."""

    def __init__(self, clock: SteppedTime) -> None:
        self.clock = clock

    def start(self, name: str, target: Callable[[], object], argv: Sequence[str]) -> Program:
        """Start a program; it does not run before time passes."""
        program = Program(NodeProcess(name, self.clock))
        program.process.start(
            target,
            argv=argv,
            env={**os.environ, "COLUMNS": "80"},
            stdout=lambda text: program.output.append(("stdout", text)),
            stderr=lambda text: program.output.append(("stderr", text)),
        )
        return program

    def python(self, *words: str) -> Program:
        """Start `python FILE ...` or `python -c TEXT`."""
        if words[0] == "-c":
            return self.start("python", lambda: _run_text(words[1]), ["-c", *words[2:]])
        return self.start("python", file_program(words[0]), words)

    def ros2(self, *words: str) -> Program:
        """Start `ros2 ...`."""
        return self.start("ros2", lambda: _run_ros2(words), ["ros2", *words])

    def executable(self, package: str, executable: str, *words: str) -> Program:
        """Start what `ros2 run PACKAGE EXECUTABLE ...` runs."""
        from bot_console.runtime.workspace.executables import executables
        from bot_console.runtime.workspace.program import program

        target = program(executables(package)[executable])
        assert target is not None
        return self.start(executable, target, [executable, *words])

    def ask(self, *words: str, stop_after: float | None = None) -> Program:
        """Run `ros2 ...` to its end, or interrupt it after `stop_after` s."""
        return self.finish(self.ros2(*words), stop_after)

    def finish(self, program: Program, stop_after: float | None = None) -> Program:
        """Let time pass until a program has ended, or interrupt it after `stop_after` s."""
        if stop_after is not None:
            self.run(stop_after)
            program.process.interrupt()
        assert program.process.wait(LONG) is not None, f"it does not end; it is at {program.process.line()}"
        return program

    def run(self, seconds: float) -> None:
        """Let this much time (s) pass."""
        self.clock.run_for(seconds)


@contextmanager
def system() -> Iterator[System]:
    """A system whose programs are ended when the block is left."""
    with stepped(stall_s=STALL) as clock:
        yield System(clock)


def _run_text(text: str) -> None:
    names: dict[str, Any] = {"__name__": "__main__"}
    sys.path.insert(0, "")
    exec(compile(text, "<string>", "exec"), names)


def _run_ros2(words: Sequence[str]) -> None:
    from ros2cli import main

    sys.exit(main(words))
