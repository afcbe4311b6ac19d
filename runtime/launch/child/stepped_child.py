"""A user's program in a stepped run: a separate process that takes turns in the run's time."""

from __future__ import annotations

import asyncio
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from typing import Any

from bot_console.runtime.children.own_processes import MEMBER_PROGRAM, fork_server
from bot_console.runtime.process.fork_server import Job, Report
from bot_console.runtime.process.lockstep.coordinator import Coordinator
from bot_console.runtime.process.lockstep.member_process import MemberProcess
from launch.child.child import Output
from launch.child.forked_child import ForkedChild
from launch.child.python_program import PythonProgram


class SteppedChild(ForkedChild):
    """A process whose output is read in its turns, so that all of it arrives at a fixed time of the run."""

    def __init__(self, member: MemberProcess, name: str, output: Output, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__(name, output, loop)
        self._member = member
        self._report = Report()
        self._exit_report = b""
        self._input = -1

    def read_all(self, report: int, stdout: int, stderr: int, data: int, stdin: int) -> None:
        """Read these descriptors in its turns; `stdin` is our end of its standard input."""
        self._input = stdin
        self._member.read(report, self._take_report, self._pass_on_exit, at_once=True)
        for fd, end in ((1, stdout), (2, stderr)):
            self._member.read(
                end,
                partial(self._in_loop, self.pipe_data_received, fd),
                partial(self._in_loop, self.pipe_connection_lost, fd, None),
            )
        self._member.read(data, partial(self._in_loop, self.news.feed), partial(self._in_loop, self.news_end))

    def _take_report(self, data: bytes) -> None:
        self._report.feed(data)
        self._member.pid, self._member.exit_code = self._report.pid or 0, self._report.exit_code
        if self._report.exit_code is None:
            self._in_loop(self.reported, data)
        else:
            self._exit_report = data

    def _pass_on_exit(self) -> None:
        if self._exit_report:
            self._in_loop(self.reported, self._exit_report)
        self._in_loop(self.all_reported)

    def _in_loop(self, callback: Callable[..., Any], *arguments: Any) -> None:
        try:
            self._loop.call_soon_threadsafe(callback, *arguments)
        except RuntimeError:  # the launch is over, so nobody needs the callback
            return

    def send_signal(self, signum: int) -> None:
        """Deliver a signal, in the process's next turn."""
        self._member.send_signal(operator.index(signum))

    def write(self, data: bytes) -> None:
        """Write bytes to its standard input."""
        os.write(self._input, data)

    def close(self) -> None:
        """Close its standard input; the rest is closed when it ends."""
        super().close()
        if self._input >= 0:
            os.close(self._input)
            self._input = -1


async def start_stepped_child(
    coordinator: Coordinator,
    program: PythonProgram,
    name: str,
    *,
    argv: Sequence[str],
    env: Mapping[str, str],
    cwd: str | None,
    emulate_tty: bool,
    output: Output,
) -> SteppedChild:
    """Run a program in a separate process of the run; raises `OSError` if it cannot be started."""
    from launch.child.terminals import open_pipes, open_terminals

    member = coordinator.new_member(name)
    child = SteppedChild(member, name, output, asyncio.get_running_loop())
    arguments = (member.number, program.function, program.arguments)
    job = Job(name, MEMBER_PROGRAM, arguments, list(argv), dict(env), os.path.abspath(cwd or os.getcwd()))
    with ExitStack() as kept, ExitStack() as given:
        out, error = open_terminals() if emulate_tty else open_pipes()
        child_input, own_input = os.pipe()
        own_data, child_data = os.pipe()
        for each in (child_input, out.child_end, error.child_end, child_data):
            given.callback(os.close, each)
        for each in (own_input, own_data, out.own_end, error.own_end):
            kept.callback(os.close, each)
        report = fork_server().start(
            job,
            stdin=child_input,
            stdout=out.child_end,
            stderr=error.child_end,
            data=child_data,
            channel=member.member_end.fileno(),
        )
        kept.pop_all()  # the two objects below own them
    child.read_all(report, out.own_end, error.own_end, own_data, own_input)
    member.start()
    await child.started
    return child
