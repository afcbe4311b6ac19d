"""A user's program in a stepped run: a separate process that takes turns in simulated time."""

from __future__ import annotations

import asyncio
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from bot_console.runtime.children.own_fork_server import MEMBER_PROGRAM
from bot_console.runtime.process.fork_server import Job, Report
from bot_console.runtime.process.lockstep.coordinator import Coordinator
from bot_console.runtime.process.lockstep.member_process import MemberProcess
from launch.child.child import Output
from launch.child.forked_child import ForkedChild, OwnEnds, start_job
from launch.child.python_program import PythonProgram


class SteppedChild(ForkedChild):
    """A process whose output is read in its turns, so that all of it arrives at a fixed time of the run."""

    def __init__(self, member: MemberProcess, name: str, output: Output, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__(name, output, loop)
        self._member = member
        self._report = Report()
        self._exit_report = b""
        self._input = -1

    def read_all(self, own: OwnEnds) -> None:
        """Read the process's streams in its turns."""
        self._input = own.stdin
        self._member.read(own.report, self._take_report, self._pass_on_exit, at_once=True)
        for fd, end in ((1, own.stdout), (2, own.stderr)):
            self._member.read(
                end,
                partial(self._in_loop, self.pipe_data_received, fd),
                partial(self._in_loop, self.pipe_connection_lost, fd, None),
            )
        self._member.read(own.data, partial(self._in_loop, self.news.feed), partial(self._in_loop, self.on_news_end))

    def _take_report(self, data: bytes) -> None:
        self._report.feed(data)
        self._member.pid, self._member.exit_code = self._report.pid or 0, self._report.exit_code
        if self._report.exit_code is None:
            self._in_loop(self.on_report, data)
        else:
            self._exit_report = data

    def _pass_on_exit(self) -> None:
        if self._exit_report:
            self._in_loop(self.on_report, self._exit_report)
        self._in_loop(self.on_reports_end)

    def _in_loop(self, callback: Callable[..., object], *arguments: object) -> None:
        try:
            self._loop.call_soon_threadsafe(callback, *arguments)
        except RuntimeError:  # the launch has ended, so nobody needs the callback
            return

    def send_signal(self, signum: int) -> None:
        """Deliver a signal, in the process's next turn."""
        self._member.send_signal(operator.index(signum))

    def write(self, data: bytes) -> None:
        """Write bytes to the process's standard input."""
        os.write(self._input, data)

    def close(self) -> None:
        """Close the process's standard input; the rest is closed when the process ends."""
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
    member = coordinator.new_member(name)
    child = SteppedChild(member, name, output, asyncio.get_running_loop())
    arguments = (member.number, program.function, program.arguments)
    job = Job(name, MEMBER_PROGRAM, arguments, list(argv), dict(env), os.path.abspath(cwd or os.getcwd()))
    child.read_all(start_job(job, emulate_tty=emulate_tty, channel=member.member_end.fileno()))
    member.start()
    await child.started
    return child
