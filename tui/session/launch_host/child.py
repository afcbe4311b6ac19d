"""Starts and ends a launch host that a console owns."""

from __future__ import annotations

import contextlib
import signal
import socket
import subprocess
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import IO

from bot_console.tui.child_command import child_command

SWITCH = "bot_console.tui.session.host_program"
END_S = 15.0
"""Seconds that a host may take to end after its owner has disconnected."""


@dataclass(frozen=True)
class Host:
    """A launch host that this process owns, and the connection to it."""

    process: subprocess.Popen[bytes]
    connection: socket.socket
    rest: threading.Thread
    """Ends what the host leaves behind, in whatever way the host ends."""
    hangs: Callable[[], bool]
    """Whether the host hangs, so that it cannot notice that its owner disconnects."""

    def thaw(self) -> None:
        """Resume the host if it is frozen: otherwise it could not end what it has started."""
        self.process.send_signal(signal.SIGCONT)

    def end(self, timeout_s: float = END_S) -> None:
        """Close the connection, which ends the host and everything that it has started; wait, and kill a host that
        takes too long.

        A host that hangs is killed at once.
        """
        with contextlib.suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)
        self.connection.close()
        try:
            self.process.wait(0.0 if self.hangs() else timeout_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
        self.rest.join()


def start_host_process(
    options: Sequence[str],
    output: IO[bytes] | int,
    *,
    env: Mapping[str, str] | None = None,
    end_session: Callable[[int], object] = lambda pid: None,
    hangs: Callable[[int], bool] = lambda pid: False,
) -> Host:
    """Start a host that this process owns: when the owner disconnects, the host ends everything that it has started,
    then itself.

    Anything that the host itself prints goes to `output`. `end_session` ends the programs of a host that was killed,
    given the host's pid; `hangs` returns whether a host does not respond.
    """
    ours, theirs = socket.socketpair()
    with theirs:
        process = subprocess.Popen(
            [*child_command(SWITCH), "--owner", str(theirs.fileno()), *options],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
            env=env,
        )

    def end_rest() -> None:
        if process.wait() != 0:  # the host was killed; otherwise it has ended its programs itself
            end_session(process.pid)

    rest = threading.Thread(target=end_rest, name="rest of the launch host", daemon=True)
    rest.start()
    return Host(process, ours, rest, lambda: hangs(process.pid))
