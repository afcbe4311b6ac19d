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
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType

from bot_console.tui.cli.foreground.hang_watch import FILE
from bot_console.tui.files.folders import state_folder

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; nothing is measured by it."""
STACKS_TIMEOUT_S = 5.0
"""Seconds that a console which a test has waited for in vain gets to write the stacks of its threads."""
POLL_S = 0.02


class Terminal:
    """A program in a terminal of a given size; it ends with the block.

    A thread reads everything that the program writes, so that the program never blocks while a test waits for another.
    """

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
        self.folder = folder
        self._output = b""
        self._reads = threading.Lock()
        self._ended, self._end = os.pipe()
        self._reader = threading.Thread(target=self._read_all, daemon=True)
        self._reader.start()
        self._stacks = state_folder() / FILE
        self._stacks_before = self._stacks.stat().st_size if self._stacks.exists() else 0

    def __enter__(self) -> Terminal:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def output(self) -> bytes:
        """The output of the program; a test may discard what it no longer needs."""
        return self._output

    @output.setter
    def output(self, value: bytes) -> None:
        with self._reads:
            self._output = value

    def read_until(self, condition: Callable[[], object], what: str) -> None:
        """Wait until a condition of the program's output holds."""
        deadline = time.monotonic() + TIMEOUT_S
        while not condition():
            if time.monotonic() >= deadline:
                stacks = self.stacks(STACKS_TIMEOUT_S)
                raise AssertionError(f"no {what}; the screen ended with {self.output[-800:]!r}\n{stacks}")
            if (ended := self.process.poll()) is not None:
                self._read_rest()
                if condition():
                    return
                assert "end" in what, f"ended ({ended}) before {what}: {self.output[-1500:]!r}"
            self.drain(POLL_S)

    def _read_all(self) -> None:
        while self._ended not in (ready := select.select([self.master, self._ended], [], [])[0]):
            if ready:
                try:
                    self._read_once()
                except OSError:  # Linux reports in this way that nobody has the other end
                    return

    def _read_once(self) -> bool:
        """Read the available output; return whether there was any."""
        with self._reads:
            if self.master < 0 or not select.select([self.master], [], [], 0)[0]:
                return False
            self._output += os.read(self.master, 65536)
            return True

    def _read_rest(self) -> None:
        with contextlib.suppress(OSError):
            while self._read_once():
                pass

    def stacks(self, timeout_s: float = TIMEOUT_S) -> str:
        """The state of a console's screen and the stacks of its threads, as it writes them on request."""
        if self.process.poll() is not None or not self._stacks.exists():
            return "it keeps no stacks"
        self.process.send_signal(signal.SIGUSR1)
        deadline = time.monotonic() + timeout_s
        while f"process {self.process.pid}:" not in (text := self._written()):
            if time.monotonic() >= deadline:  # The drawing thread hangs.
                self.process.send_signal(signal.SIGABRT)
                self.process.wait()
                return self._written()
            self.drain(POLL_S)
        return text

    def _written(self) -> str:
        return self._stacks.read_bytes()[self._stacks_before :].decode(errors="replace")

    def drain(self, seconds: float) -> None:
        """Let time pass while the program's output is read."""
        threading.Event().wait(seconds)

    def type(self, keys: str) -> None:
        """Press keys."""
        left = keys.encode()
        while left:
            left = left[os.write(self.master, left) :]

    def unread(self) -> int:
        """The number of bytes typed that the program has not read."""
        return int.from_bytes(fcntl.ioctl(self._slave, termios.FIONREAD, bytes(4)), sys.byteorder)

    def wait(self) -> int:
        """Wait for the end of the program; return its exit code."""
        self.read_until(lambda: self.process.poll() is not None, "the end of the program")
        self._read_rest()
        return self.process.returncode

    def is_usable(self) -> bool:
        """Whether the program has left the alternate screen, shown the cursor and restored the line settings."""
        left = self.output.rfind(b"\x1b[?1049l") > self.output.rfind(b"\x1b[?1049h")
        shown = self.output.rfind(b"\x1b[?25h") > self.output.rfind(b"\x1b[?25l")
        return left and shown and self.modes() == self.settings[3]

    def modes(self) -> int:
        """The line settings (`c_lflag`)."""
        return termios.tcgetattr(self._slave)[3]

    def processes(self) -> list[str]:
        """The command lines of the program and all its descendants."""
        found: list[str] = []
        for each in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                if f"ROS_HOME={self.folder}".encode() in (each / "environ").read_bytes().split(b"\0"):
                    found.append((each / "cmdline").read_bytes().replace(b"\0", b" ").decode())
        return found

    def hang_up(self) -> None:
        """Make the terminal vanish without a signal."""
        os.write(self._end, b"end")
        self._reader.join()
        for each in (self.master, self._slave, self._ended, self._end):
            os.close(each)
        self.master = -1

    def close(self) -> None:
        """End the program, whatever state it is in."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        if self.master >= 0:
            self.hang_up()
