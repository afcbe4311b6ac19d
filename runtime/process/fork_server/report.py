"""What the fork server reports about a child: its pid at once, its exit code when it has ended."""

from __future__ import annotations

import os


class Report:
    """Collects the bytes that come from the descriptor which `ForkServer.start` gives."""

    def __init__(self) -> None:
        self._text = b""
        self.pid: int | None = None
        self.exit_code: int | None = None
        """As of `subprocess`: negative for a signal."""
        self.problem = ""
        """Why it could not be started."""

    def feed(self, data: bytes) -> None:
        """Take the next bytes."""
        *lines, self._text = (self._text + data).split(b"\n")
        for line in lines:
            kind, _, value = line.decode().partition(" ")
            if kind == "pid":
                self.pid = int(value)
            elif kind == "exit":
                self.exit_code = int(value)
            else:
                self.problem = value


def tell_pid(descriptor: int, pid: int) -> None:
    """Say that the child runs."""
    _write(descriptor, f"pid {pid}\n")


def tell_exit(descriptor: int, code: int) -> None:
    """Say that the child has ended; the last word."""
    _write(descriptor, f"exit {code}\n")


def tell_problem(descriptor: int, text: str) -> None:
    """Say that there is no child; the last word."""
    _write(descriptor, f"problem {text}\n")


def _write(descriptor: int, text: str) -> None:
    try:
        os.write(descriptor, text.encode())
    except BrokenPipeError:  # nobody wants to know
        return
