"""A separate process for a Python program, forked from a server that has imported everything."""

from __future__ import annotations

import asyncio
import operator
import os
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import NamedTuple

from bot_console.runtime.children.child_discovery import children_meet
from bot_console.runtime.children.own_fork_server import begun, fork_server
from bot_console.runtime.process.fork_server import Job, Report
from launch.child.child import Output
from launch.child.process_reports import NewsReader
from launch.child.python_program import PythonProgram
from launch.child.streamed_child import StreamedChild, read_output, read_stream

UNKNOWN = 255
"""Exit code of a process whose fork server was killed, as nobody can get the real one from the system."""
UNKNOWN_TEXT = b"the fork server was killed, so the exit code of this process is not known\n"

DATA = 3
"""The data pipe as an open stream, so that the process's last reports are waited for."""


class ForkedChild(StreamedChild):
    """A real process in its own session, which the terminal's Ctrl-C does not reach."""

    gets_signals_of_terminal = False

    def __init__(self, name: str, output: Output, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__(output, loop)
        self.open_streams.add(DATA)
        self.pid = 0
        self.report = Report()
        self.news = NewsReader(name, self._unheard)
        self.started: asyncio.Future[None] = loop.create_future()
        self.transports: list[asyncio.BaseTransport] = []
        self.input: asyncio.WriteTransport | None = None

    def on_news_end(self) -> None:
        """Handle the end of the data pipe."""
        self.news.close()
        self.pipe_connection_lost(DATA, None)

    def _unheard(self, text: str) -> None:
        """Print news that no hook takes, so that a person may read them."""
        self.pipe_data_received(2, text.encode())

    def on_report(self, data: bytes) -> None:
        """Handle a report from the fork server."""
        self.report.feed(data)
        if self.report.pid is not None and not self.started.done():
            self.pid = self.news.pid = self.report.pid
            self.started.set_result(None)
        if self.report.exit_code is not None:
            self.on_exit(self.report.exit_code)

    def on_reports_end(self) -> None:
        """Handle the end of the fork server's reports, for whatever reason."""
        if not self.started.done():
            text = self.report.problem or "the fork server has ended"
            self.started.set_exception(OSError(f"cannot start a process: {text}"))
        elif self.report.exit_code is None:
            self.pipe_data_received(2, UNKNOWN_TEXT)
            self._loop.create_task(self._outlive_server())

    async def _outlive_server(self) -> None:
        """Wait for the end of a process whose server has ended; only its open streams show that it is still running."""
        while self.open_streams:
            await asyncio.sleep(0.2)
        self.on_exit(UNKNOWN)

    def send_signal(self, signum: int) -> None:
        """Deliver a signal; raises `ProcessLookupError` after the end."""
        if self.report.exit_code is not None:
            raise ProcessLookupError
        os.kill(self.pid, operator.index(signum))

    def write(self, data: bytes) -> None:
        """Write bytes to the process's standard input."""
        if self.input is not None:
            self.input.write(data)

    def close(self) -> None:
        """Close its pipes and terminals."""
        self.news.close()
        for each in self.transports:
            each.close()


class OwnEnds(NamedTuple):
    """Our ends of the connections to a process of the fork server; the caller must close them."""

    report: int
    stdout: int
    stderr: int
    data: int
    stdin: int


def start_job(job: Job, *, emulate_tty: bool, channel: int | None = None) -> OwnEnds:
    """Let the fork server start a job with new streams; raises `OSError`, and then leaves nothing open."""
    from launch.child.terminals import open_pipes, open_terminals

    with ExitStack() as kept, ExitStack() as given:
        out, error = open_terminals() if emulate_tty else open_pipes()
        child_input, own_input = os.pipe()
        own_data, child_data = os.pipe()
        for each in (child_input, out.child_end, error.child_end, child_data):
            given.callback(os.close, each)
        for each in (own_input, own_data, out.own_end, error.own_end):
            kept.callback(os.close, each)
        report = fork_server().start(
            job, stdin=child_input, stdout=out.child_end, stderr=error.child_end, data=child_data, channel=channel
        )
        kept.pop_all()
    return OwnEnds(report, out.own_end, error.own_end, own_data, own_input)


async def start_forked_child(
    program: PythonProgram,
    name: str,
    *,
    argv: Sequence[str],
    env: Mapping[str, str],
    cwd: str | None,
    emulate_tty: bool,
    output: Output,
) -> ForkedChild:
    """Run a program in a separate process; raises `OSError` if it cannot be started."""
    loop = asyncio.get_running_loop()
    child = ForkedChild(name, output, loop)
    words = (children_meet(), program.function, program.arguments)
    first = f"{begun.__module__}:{begun.__name__}"
    job = Job(name, first, words, list(argv), dict(env), os.path.abspath(cwd or os.getcwd()))
    own = start_job(job, emulate_tty=emulate_tty)
    child.transports.append(await read_stream(own.report, child.on_report, child.on_reports_end))
    child.transports.append(await read_stream(own.data, child.news.feed, child.on_news_end))
    for fd, end in ((1, own.stdout), (2, own.stderr)):
        child.transports.append(await read_output(child, fd, end))
    child.input, _ = await loop.connect_write_pipe(asyncio.Protocol, os.fdopen(own.stdin, "wb", buffering=0))
    child.transports.append(child.input)
    await child.started
    return child
