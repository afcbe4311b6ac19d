"""The fork server's report on a child: its pid at once, and its exit code when it has ended."""

from __future__ import annotations

import os


class Report:
    """Parses the bytes read from the descriptor that `ForkServer.start` returns."""

    def __init__(self) -> None:
        self._text = b""
        self.pid: int | None = None
        self.exit_code: int | None = None
        """The exit code as in `subprocess`: negative for a signal. None until the child has ended."""
        self.problem = ""
        """Why the child could not be started; empty if it was."""

    def feed(self, data: bytes) -> None:
        """Parse the next bytes."""
        *lines, self._text = (self._text + data).split(b"\n")
        for line in lines:
            kind, _, value = line.decode().partition(" ")
            if kind == "pid":
                self.pid = int(value)
            elif kind == "exit":
                self.exit_code = int(value)
            else:
                self.problem = value


def report_pid(descriptor: int, pid: int) -> None:
    """Report that the child is running."""
    _write(descriptor, f"pid {pid}\n")


def report_exit(descriptor: int, code: int) -> None:
    """Report that the child has ended; the final line."""
    _write(descriptor, f"exit {code}\n")


def report_problem(descriptor: int, text: str) -> None:
    """Report that the child could not be started; the final line."""
    _write(descriptor, f"problem {text}\n")


def _write(descriptor: int, text: str) -> None:
    try:
        os.write(descriptor, text.encode())
    except BrokenPipeError:  # nobody reads the report any more
        return
