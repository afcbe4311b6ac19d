"""A pseudo-terminal with a program in it, driven by tests."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from bot_console.tui.cli.foreground.hang_watch import FILE
from bot_console.tui.files.folders import state_folder

TIMEOUT_S = 120.0
"""Seconds after which a test gives up; nothing is measured by it."""
STACKS = 5.0
"""Seconds that a console may take to write the stacks of its threads."""


class Terminal:
    """A program in a terminal of a given size."""

    def __init__(self, words: Sequence[str], folder: Path, size: tuple[int, int] = (120, 40)) -> None:
        self.master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", size[1], size[0], 0, 0))
        self.settings = termios.tcgetattr(slave)
        self._slave = slave
        environment = {**os.environ, "TERM": "xterm-256color", "COLORTERM": "truecolor", "ROS_HOME": str(folder)}
        environment.pop("RCUTILS_CONSOLE_OUTPUT_FORMAT", None)
        self.process = subprocess.Popen(
            [sys.executable, *words], cwd=folder, env=environment, start_new_session=True,
            stdin=slave, stdout=slave, stderr=slave,
        )  # fmt: skip
        self.output = b""
        self.folder = folder
        self._stacks = state_folder() / FILE
        self._stacks_before = self._stacks.stat().st_size if self._stacks.exists() else 0

    def read_until(self, condition: Callable[[], bool], what: str) -> None:
        """Read the program's output until a condition holds."""
        deadline = time.monotonic() + TIMEOUT_S
        while not condition():
            if time.monotonic() >= deadline:
                raise AssertionError(f"no {what}; the screen ended with {self.output[-800:]!r}\n{self.stacks()}")
            ended = self.process.poll()
            self._read(0.05)
            assert ended is None or "end" in what, f"ended ({ended}) before {what}: {self.output[-1500:]!r}"

    def _read(self, seconds: float) -> None:
        if select.select([self.master], [], [], seconds)[0]:
            with contextlib.suppress(OSError):
                self.output += os.read(self.master, 65536)

    def stacks(self) -> str:
        """The state of a console's screen and the stacks of its threads, as it writes them on request."""
        if self.process.poll() is not None or not self._stacks.exists():
            return "it keeps no stacks"
        self.process.send_signal(signal.SIGUSR1)
        deadline = time.monotonic() + STACKS
        while f"process {self.process.pid}:" not in (text := self._written()):
            if time.monotonic() >= deadline:  # The drawing thread hangs.
                self.process.send_signal(signal.SIGABRT)
                self.process.wait()
                return self._written()
            self._read(0.05)
        return text

    def _written(self) -> str:
        return self._stacks.read_bytes()[self._stacks_before :].decode(errors="replace")

    def drain(self, seconds: float) -> None:
        """Read the program's output for a while."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            self._read(left)

    def type(self, keys: str) -> None:
        """Press keys."""
        os.write(self.master, keys.encode())

    def wait(self) -> int:
        """The exit code, once the program has ended."""
        self.read_until(lambda: self.process.poll() is not None, "the end of the program")
        self._read(0.2)
        return self.process.returncode

    def is_usable(self) -> bool:
        """Whether the program has left the alternate screen, shows the cursor and has restored the line settings."""
        left = self.output.rfind(b"\x1b[?1049l") > self.output.rfind(b"\x1b[?1049h")
        shown = self.output.rfind(b"\x1b[?25h") > self.output.rfind(b"\x1b[?25l")
        return left and shown and self.modes() == self.settings[3]

    def modes(self) -> int:
        """The line settings (`c_lflag`)."""
        return termios.tcgetattr(self._slave)[3]

    def processes(self) -> list[str]:
        """The command lines of all processes that descend from this program, itself included."""
        found: list[str] = []
        for each in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                if f"ROS_HOME={self.folder}".encode() in (each / "environ").read_bytes().split(b"\0"):
                    found.append((each / "cmdline").read_bytes().replace(b"\0", b" ").decode())
        return found

    def hang_up(self) -> None:
        """Make the terminal vanish without a signal."""
        os.close(self.master)
        os.close(self._slave)
        self.master = -1

    def close(self) -> None:
        """End the program, whatever state it is in."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        if self.master >= 0:
            self.hang_up()
