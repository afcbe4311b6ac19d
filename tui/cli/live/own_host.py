"""The launch host that a console has started and owns."""

from __future__ import annotations

import contextlib
import os
import socket
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from bot_console.runtime.process.watch.held_lock import HeldLock
from bot_console.tui.own_program import own_program

SWITCH = "bot_console.tui.cli.live.launch_host"
END_S = 15.0
"""Seconds that a host may take to end, after its owner has hung up."""


@dataclass(frozen=True)
class Host:
    """A launch host that this process owns, and the connection to it."""

    process: subprocess.Popen[bytes]
    connection: socket.socket

    def end(self, patience: float = END_S) -> None:
        """Hang up, which ends it and all that it has started; waits for that, and kills it when it takes too long.

        One whose interpreter's lock is held hears of nothing, and is killed at once.
        """
        with contextlib.suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)
        self.connection.close()
        try:
            self.process.wait(0.0 if HeldLock(self.process.pid).held_in() else patience)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


def start_host(options: Sequence[str] = (), *, log: Path | None = None) -> Host:
    """Start a host that this process owns: when it hangs up, the host ends all that it has started, then itself.

    What the host itself prints, which should be nothing, goes to a file.
    """
    ours, theirs = socket.socketpair()
    with theirs, open(log or os.devnull, "ab") as output:
        process = subprocess.Popen(
            [*own_program(SWITCH), "--owner", str(theirs.fileno()), *options],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
        )
    return Host(process, ours)
