"""The launch host that a console starts and owns."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from bot_console.runtime.process.session_end import end_session
from bot_console.runtime.process.watch.gil_holder import GilHolder
from bot_console.tui.child_command import child_command

SWITCH = "bot_console.tui.session.host_program"
END_S = 15.0
"""Seconds that a host may take to end after its owner has hung up."""


@dataclass(frozen=True)
class Host:
    """A launch host that this process owns, and the connection to it."""

    process: subprocess.Popen[bytes]
    connection: socket.socket
    rest: threading.Thread
    """Ends what the host leaves behind, however it ends."""

    def thaw(self) -> None:
        """Let it continue if it is frozen: otherwise it could not end what it has started."""
        self.process.send_signal(signal.SIGCONT)

    def end(self, timeout_s: float = END_S) -> None:
        """Close the connection, which ends the host and all it started; waits, and kills it if that takes too long.

        A host whose interpreter lock is held does not notice, and is killed at once.
        """
        with contextlib.suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)
        self.connection.close()
        try:
            self.process.wait(0.0 if GilHolder(self.process.pid).held_in() else timeout_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
        self.rest.join()


def start_host(options: Sequence[str] = (), *, log: Path | None = None) -> Host:
    """Start a host that this process owns: when the owner hangs up, the host ends everything it has started, then
    itself.

    What the host itself prints, which should be nothing, goes to the file `log`.
    """
    ours, theirs = socket.socketpair()
    with theirs, open(log or os.devnull, "ab") as output:
        process = subprocess.Popen(
            [*child_command(SWITCH), "--owner", str(theirs.fileno()), *options],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
        )
    rest = threading.Thread(target=_end_rest, args=(process,), name="rest of the launch host", daemon=True)
    rest.start()
    return Host(process, ours, rest)


def _end_rest(host: subprocess.Popen[bytes]) -> None:
    """Wait until a host has ended. If it was killed, end its programs; otherwise it has done so itself."""
    if host.wait() != 0:
        end_session(host.pid)
