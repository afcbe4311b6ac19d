"""An operating system process as a child of a launch."""

from __future__ import annotations

import asyncio
import os
import subprocess
from collections.abc import Mapping, Sequence
from typing import Any

from launch.child.child import Output
from launch.child.streamed_child import StreamedChild, read_output


class OsChild(StreamedChild, asyncio.SubprocessProtocol):
    """An operating system process, whose output is read from pipes or from its own pseudo terminals."""

    gets_signals_of_terminal = True

    def __init__(self, output: Output, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__(output, loop)
        self.terminals: list[asyncio.ReadTransport] = []
        self.pid = 0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Record the started process."""
        assert isinstance(transport, asyncio.SubprocessTransport)
        self._transport = transport
        self.pid = transport.get_pid()

    def process_exited(self) -> None:
        """Handle the process's exit."""
        self.on_exit(self._transport.get_returncode() or 0)

    def send_signal(self, signum: int) -> None:
        """Deliver a signal; raises `ProcessLookupError` after the end."""
        if self._transport.get_returncode() is not None:
            raise ProcessLookupError
        # Not the transport's own method: `Popen.send_signal` polls, and may take the exit code away from asyncio (then
        # 255).
        os.kill(self.pid, signum)

    def write(self, data: bytes) -> None:
        """Write bytes to the process's standard input."""
        pipe: Any = self._transport.get_pipe_transport(0)
        if pipe is not None:
            pipe.write(data)

    def close(self) -> None:
        """Close its pipes and terminals."""
        self._transport.close()
        for terminal in self.terminals:
            terminal.close()


async def start_os_child(
    command: Sequence[str],
    *,
    shell: bool,
    emulate_tty: bool,
    env: Mapping[str, str],
    cwd: str | None,
    output: Output,
) -> OsChild:
    """Run a command; raises whatever the start raises, mostly `OSError`."""
    loop = asyncio.get_running_loop()
    child = OsChild(output, loop)
    if not emulate_tty or os.name == "nt":
        await _start(loop, child, command, shell, env=env, cwd=cwd)
        return child
    from launch.child.terminals import open_terminals

    ends = open_terminals()
    try:
        await _start(loop, child, command, shell, env=env, cwd=cwd, stdout=ends[0].child_end, stderr=ends[1].child_end)
    except BaseException:
        for end in ends:
            os.close(end.own_end)
        raise
    finally:
        for end in ends:
            os.close(end.child_end)
    for fd, end in zip((1, 2), ends, strict=True):
        child.terminals.append(await read_output(child, fd, end.own_end))
    return child


async def _start(
    loop: asyncio.AbstractEventLoop, child: OsChild, command: Sequence[str], shell: bool, **options: Any
) -> None:
    options.setdefault("stdout", subprocess.PIPE)
    options.setdefault("stderr", subprocess.PIPE)
    if shell:
        await loop.subprocess_shell(lambda: child, " ".join(command), stdin=subprocess.PIPE, **options)
    else:
        await loop.subprocess_exec(lambda: child, *command, stdin=subprocess.PIPE, **options)
