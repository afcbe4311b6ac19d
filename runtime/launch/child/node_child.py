"""One of our nodes, composed in this process, as a child of a launch."""

from __future__ import annotations

import asyncio
import operator
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from bot_console.runtime.process import NodeProcess
from launch.child.child import Output


class NodeChild:
    """A thread that looks like a process to its code."""

    gets_signals_of_terminal = False

    def __init__(self, process: NodeProcess, loop: asyncio.AbstractEventLoop) -> None:
        self.process = process
        self.pid = process.pid
        self.exited: asyncio.Future[int] = loop.create_future()

    def send_signal(self, signum: int) -> None:
        """Deliver a signal."""
        self.process.send_signal(operator.index(signum))

    def write(self, data: bytes) -> None:
        """Do nothing: the standard input of a node process is always at its end."""

    def close(self) -> None:
        """Do nothing: there are no resources to release."""


def start_node_child(
    program: Callable[[], object],
    name: str,
    *,
    argv: Sequence[str],
    env: Mapping[str, str],
    output: Output,
) -> NodeChild:
    """Run a program as a node process."""
    loop = asyncio.get_running_loop()
    process = NodeProcess(name)
    child = NodeChild(process, loop)

    def printed(stream: int, line: str) -> None:
        _in_loop(loop, partial(output, stream, line.encode("utf-8", "replace")))

    def ended(_process: NodeProcess) -> None:
        for capture in (process.stdout, process.stderr):
            if capture is not None:
                capture.end()
        code = process.exit_code if process.exit_code is not None else 0
        _in_loop(loop, partial(_finish, child.exited, code))

    process.on_exit(ended)
    process.start(program, argv=argv, env=env, stdout=partial(printed, 1), stderr=partial(printed, 2))
    return child


def _in_loop(loop: asyncio.AbstractEventLoop, callback: Callable[[], None]) -> None:
    try:
        loop.call_soon_threadsafe(callback)
    except RuntimeError:  # the launch has ended, so nobody needs the callback
        return


def _finish(future: asyncio.Future[int], code: int) -> None:
    if not future.done():
        future.set_result(code)
