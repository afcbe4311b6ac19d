"""Systems of programs in stepped time: commands of ours are composed, every other program is a process."""

from __future__ import annotations

import os
import re
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any, Protocol

from bot_console.runtime.children.own_fork_server import MEMBER_PROGRAM, fork_server
from bot_console.runtime.process import NodeProcess, SteppedTime, stepped
from bot_console.runtime.process.fork_server import Job, Report
from bot_console.runtime.process.lockstep.coordinator import coordinator_of
from bot_console.runtime.process.node.running import running_process
from bot_console.runtime.rmw.lockstep.coordination import coordinated_run

LONG = 240.0
"""Virtual seconds that a command which ends by itself may take."""

STALL = 30.0
"""Wall-clock seconds that a program may compute or import before the run goes on without it."""

RUN = "bot_console.runtime.programs.run:main"
"""The function behind `bot-console run`."""


class Running(Protocol):
    """What a test asks of a program that was started."""

    @property
    def exit_code(self) -> int | None:
        """Its exit code; None while it runs."""
        ...

    def interrupt(self) -> None:
        """Send it SIGINT."""
        ...

    def kill(self) -> None:
        """Send it SIGKILL."""
        ...

    def wait(self, timeout_s: float) -> int | None:
        """Wait for its end, at most `timeout_s` virtual seconds; returns its exit code."""
        ...

    def line(self) -> str:
        """Where it is, for a failed test."""
        ...


class Separate:
    """A process of the run."""

    def __init__(self, clock: SteppedTime, name: str, program: str, arguments: Sequence[Any]) -> None:
        """`program` names the function that returns what it runs, given the `arguments`."""
        coordinator = coordinator_of(clock)
        assert coordinator is not None
        self._member = coordinator.new_member(name)
        self._job = partial(Job, name, MEMBER_PROGRAM, (self._member.number, program, arguments))
        self._report = Report()
        self._clock = clock
        self._ended = clock.wakeup()

    def start(self, argv: Sequence[str], env: dict[str, str], output: Callable[[str, str], None]) -> None:
        """Start it with an empty standard input; `output` is called with a stream and what was written to it."""
        from launch.child.forked_child import start_job
        from launch.child.process_reports import NewsReader

        own = start_job(
            self._job(list(argv), env, os.getcwd()), emulate_tty=False, channel=self._member.member_end.fileno()
        )
        os.close(own.stdin)
        news = NewsReader(self._member.name, partial(output, "stderr"))
        self._member.read(own.report, self._take_report, self._ended.set, at_once=True)
        for stream, descriptor in (("stdout", own.stdout), ("stderr", own.stderr)):
            self._member.read(descriptor, partial(_decode, output, stream), lambda: None)
        self._member.read(own.data, news.feed, news.close)
        self._member.start()

    def _take_report(self, data: bytes) -> None:
        self._report.feed(data)
        self._member.pid, self._member.exit_code = self._report.pid or 0, self._report.exit_code

    @property
    def exit_code(self) -> int | None:
        """Its exit code; None while it runs."""
        return self._report.exit_code if self._ended.is_set() else None

    def interrupt(self) -> None:
        """Send it SIGINT."""
        self._send(signal.SIGINT)

    def kill(self) -> None:
        """Send it SIGKILL."""
        self._send(signal.SIGKILL)

    def _send(self, number: int) -> None:
        with suppress(ProcessLookupError):
            self._member.send_signal(int(number))

    def wait(self, timeout_s: float) -> int | None:
        """Wait for its end, at most `timeout_s` virtual seconds; returns its exit code."""
        self._ended.wait(self._clock.steady_ns() + round(timeout_s * 1e9))
        return self.exit_code

    def line(self) -> str:
        """Where it is, for a failed test."""
        return f"process {self._member.pid}"


def _decode(output: Callable[[str, str], None], stream: str, data: bytes) -> None:
    output(stream, data.decode("utf-8", "replace"))


class Program:
    """A running or ended program with its output."""

    def __init__(self, process: Running) -> None:
        self.process = process
        self.output: list[tuple[str, str]] = []

    def write(self, stream: str, text: str) -> None:
        """Take in what it has written."""
        self.output.append((stream, text))

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
    """Programs of one stepped run."""

    def __init__(self, clock: SteppedTime) -> None:
        self.clock = clock

    def compose(self, name: str, target: Callable[[], object], argv: Sequence[str]) -> Program:
        """Start a program of ours, composed in this process; it does not run before time passes."""
        process = NodeProcess(name, self.clock)
        program = Program(process)
        sinks = {stream: partial(program.write, stream) for stream in ("stdout", "stderr")}
        process.start(target, argv=argv, env=environment_of_programs(), **sinks)
        return program

    def start(self, name: str, program: str, arguments: Sequence[Any], argv: Sequence[str]) -> Program:
        """Start a program in a process of its own; it does not run before time passes.

        The function that `program` names returns it, given the `arguments`.
        """
        process = Separate(self.clock, name, program, arguments)
        started = Program(process)
        process.start(argv, environment_of_programs(), started.write)
        return started

    def function(self, name: str, *argv: str) -> Program:
        """Start `module:function`, with `sys.argv`, in a process of its own."""
        from bot_console.runtime.workspace.launched import entry_point

        return self.start(argv[0], _named(entry_point), (_folders(), name, []), argv)

    def python(self, *words: str) -> Program:
        """Start `python FILE ...` or `python -c TEXT`."""
        from bot_console.runtime.process import code_program
        from bot_console.runtime.workspace.launched import python_file

        if words[0] == "-c":
            return self.start("python", _named(code_program), (words[1],), ["-c", *words[2:]])
        folders = [os.path.dirname(os.path.abspath(words[0]))]
        return self.start("python", _named(python_file), (_folders(), words[0], folders, False), words)

    def ros2(self, *words: str) -> Program:
        """Start `ros2 ...`; what `ros2 run` runs is a program of the user."""
        if words[:1] == ("run",):
            return self.function("ros2cli:main", "ros2", *words)
        return self.compose("ros2", lambda: _run_ros2(words), ["ros2", *words])

    def executable(self, package: str, executable: str, *words: str) -> Program:
        """Start what a launch starts for a node of ours, composed in this process."""
        from bot_console.runtime.workspace.executables import executables
        from bot_console.runtime.workspace.program import program

        target = program(executables(package)[executable])
        assert target is not None
        return self.compose(executable, target, [executable, *words])

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


def kill_composed(launch: Program, name: str) -> None:
    """SIGKILL for a node of ours that a launch has started last under this name."""
    pids = re.findall(rf"\[{name}-\d+\]: process started with pid \[(\d+)\]", launch.stdout)
    process = running_process(int(pids[-1]))
    assert process is not None
    process.send_signal(signal.SIGKILL)


@contextmanager
def system() -> Iterator[System]:
    """A system whose programs are ended when the block is left."""
    fork_server()  # before the run takes one processor for itself, and what it starts
    with stepped(stall_s=STALL) as clock, coordinated_run(clock, seed=0):
        yield System(clock)


def environment_of_programs() -> dict[str, str]:
    """The environment of each program: that of the test, in a terminal of 80 columns."""
    return os.environ.copy() | {"COLUMNS": "80"}


def _folders() -> list[str]:
    from bot_console.runtime.workspace.discover import workspace

    return [str(each) for each in workspace().folders]


def _named(function: Callable[..., Any]) -> str:
    return f"{function.__module__}:{function.__name__}"


def _run_ros2(words: Sequence[str]) -> None:
    from ros2cli import main

    sys.exit(main(words))
