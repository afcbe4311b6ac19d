"""Runs command lines of `bot-console` in separate processes, forked from one that has imported what they need.

The imports take longer than most commands, and are the same each time. A test of the start itself (which modules are
imported, how it is interrupted, how the environment changes it) starts `python -m bot_console.tui` instead.
"""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path

TIMEOUT_S = 600.0
"""Seconds after which a test gives up; nothing is measured by it."""
PARENT = Path(__file__).with_name("command_line_parent.py")


class CommandLine:
    """A command line that runs as if in another terminal; its output is kept."""

    def __init__(self, *words: str, cwd: str | Path | None = None, env: Mapping[str, str] | None = None) -> None:
        self.args = ["bot-console", *words]
        self._output = [tempfile.TemporaryFile("w+", encoding="utf-8", errors="backslashreplace") for _ in range(2)]  # noqa: SIM115
        reports, report = os.pipe()
        self._reports = os.fdopen(reports, "rb", buffering=0)
        with tempfile.TemporaryFile("w+", encoding="utf-8") as request, Path(os.devnull).open() as nothing:
            json.dump([words, str(cwd or Path.cwd()), dict(os.environ if env is None else env)], request)
            request.flush()
            request.seek(0)
            socket.send_fds(_parent(), [b"."], [each.fileno() for each in (request, nothing, *self._output)] + [report])
        os.close(report)
        self.pid = int(self._reports.readline())

    def send_signal(self, number: int) -> None:
        """Send it a signal."""
        os.kill(self.pid, number)

    def has_ended(self, timeout_s: float) -> bool:
        """Whether it ends within this time (s)."""
        return bool(select.select([self._reports], [], [], timeout_s)[0])

    def end(self, number: int | None = None) -> subprocess.CompletedProcess[str]:
        """Send it a signal, if one is given, and wait for its end."""
        if number is not None:
            self.send_signal(number)
        if not self.has_ended(TIMEOUT_S):
            self.send_signal(signal.SIGKILL)
            raise TimeoutError(self.args, self._written())
        code = os.waitstatus_to_exitcode(int(self._reports.readline()))
        self._reports.close()
        return subprocess.CompletedProcess(self.args, code, *self._written())

    def _written(self) -> list[str]:
        written: list[str] = []
        for each in self._output:
            each.seek(0)
            written.append(each.read())
            each.close()
        return written


def run_cli(
    *words: str, cwd: str | Path | None = None, env: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run a command line to its end."""
    if not hasattr(os, "fork"):
        line = [sys.executable, "-m", "bot_console.tui", *words]
        return subprocess.run(line, cwd=cwd, env=env, capture_output=True, text=True, check=False, timeout=TIMEOUT_S)
    return CommandLine(*words, cwd=cwd, env=env).end()


@cache
def _parent() -> socket.socket:
    """The socket to the process that has imported everything, which ends with this one."""
    ours, its = socket.socketpair()
    subprocess.Popen([sys.executable, str(PARENT), str(its.fileno())], pass_fds=[its.fileno()], start_new_session=True)
    its.close()
    return ours
