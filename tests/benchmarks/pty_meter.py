"""A program in a pseudo-terminal at the far end of a link, and what it costs. Linux."""

from __future__ import annotations

import codecs
import fcntl
import os
import pty
import re
import select
import signal
import struct
import termios
import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from emulator import Emulator

ANSWERS = {b"\x1b[6n": b"\x1b[1;1R", b"\x1b[?2026$p": b"\x1b[?2026;2$y"}
"""Queries that the terminal answers: the cursor's position, and support for synchronized output."""
FRAME, FRAME_END = b"\x1b[?2026h", b"\x1b[?2026l"
CUT_OFF = re.compile(r"\x1b(\[[\d;?<>=$]*|\][^\x07\x1b]*)?$")
UNSHOWN = re.compile(r"\x1b\][^\x07\x1b]*(\x07|\x1b\\)|\x1b\[[?<>=][\d;$]*[@-~]|[\x00-\x1a\x7f]")
"""Sequences that change no cell: titles, modes, queries; single control characters."""
CHUNK = 1024
TICK = 0.002


@dataclass(frozen=True)
class Link:
    """The link between program and terminal.

    `rate` is in bytes per second (0: no limit), `delay` in seconds, each way; the third field is the number of bytes
    that
    may wait in the link.
    """

    rate: float = 0.0
    buffer: int = 262144
    delay: float = 0.0


class Terminal:
    """Runs a program; counts what it sends, shows it on an emulated screen, and answers its queries."""

    def __init__(
        self, command: Sequence[str], size: tuple[int, int], link: Link = Link(), *, shown: bool = True
    ) -> None:
        self._link = link
        self._waiting = bytearray()
        self._credit = 0.0
        self._travelling: deque[tuple[float, bytes]] = deque()
        self._typed: deque[tuple[float, bytes]] = deque()
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._tail = ""
        self._end = b""
        self.screen = Emulator(*size) if shown else None
        self.reading = True
        self.over = False
        self.received = self.frames = self.frames_ended = 0
        self.began = self._last = time.monotonic()
        self.pid, self._pty = pty.fork()
        if self.pid == 0:
            _become(command, size)
        os.set_blocking(self._pty, False)

    def run(self, seconds: float, until: Callable[[], object] = lambda: False) -> bool:
        """Let the program run for `seconds`, or until a condition holds; return whether it did."""
        end = time.monotonic() + seconds
        while not self.over and not until():
            now = time.monotonic()
            if now >= end:
                return False
            self._step(now)
        return bool(until())

    def press(self, key: str) -> None:
        """Press a key at this end of the link."""
        self._typed.append((time.monotonic() + self._link.delay, key.encode()))

    def text(self) -> str:
        """What the screen shows."""
        return "\n".join(self.screen.lines()) if self.screen else ""

    def cpu(self) -> float:
        """CPU time (s) of the program and its living descendants."""
        used: dict[int, int] = {}
        parents: dict[int, int] = {}
        for each in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{each}/stat", "rb") as file:
                    fields = file.read().rpartition(b")")[2].split()
            except OSError:  # It has ended meanwhile.
                continue
            parents[int(each)], used[int(each)] = int(fields[1]), int(fields[11]) + int(fields[12])
        family = [self.pid]
        for one in family:
            family += [each for each, parent in parents.items() if parent == one]
        return sum(used.get(each, 0) for each in family) / os.sysconf("SC_CLK_TCK")

    def threads(self) -> dict[int, float]:
        """CPU time (s) of each living thread, to the nanosecond; the drawing thread has the program's id."""
        found: dict[int, float] = {}
        for each in os.listdir(f"/proc/{self.pid}/task"):
            try:
                with open(f"/proc/{self.pid}/task/{each}/schedstat") as file:
                    found[int(each)] = int(file.read().split()[0]) / 1e9
            except OSError:  # It has ended meanwhile.
                continue
        return found

    def close(self, grace: float = 5.0) -> float:
        """End the program as a closing session does; return the seconds until it was gone."""
        began = time.monotonic()
        os.kill(self.pid, signal.SIGTERM)
        while not os.waitpid(self.pid, os.WNOHANG)[0]:
            if time.monotonic() - began > grace:
                os.kill(self.pid, signal.SIGKILL)
                os.waitpid(self.pid, 0)
                break
            self._step(time.monotonic())
        os.close(self._pty)
        return time.monotonic() - began

    def _step(self, now: float) -> None:
        while self._typed and self._typed[0][0] <= now:
            os.write(self._pty, self._typed.popleft()[1])
        room = not self._link.rate or len(self._waiting) < self._link.buffer
        listened = [self._pty] if self.reading and room and not self.over else []
        if select.select(listened, [], [], TICK)[0]:
            try:
                data = os.read(self._pty, 65536 if not self._link.rate else CHUNK)
            except OSError:
                data = b""
            self.over = not data
            self._waiting += data
        self._pass_on(time.monotonic())

    def _pass_on(self, now: float) -> None:
        """Pass on what the rate of the link allows, then process what has arrived."""
        count = len(self._waiting)
        if self._link.rate:
            self._credit = min(self._credit + (now - self._last) * self._link.rate, self._link.rate * 0.05 + CHUNK)
            count = min(count, int(self._credit))
            self._credit -= count
        self._last = now
        if count:
            self._travelling.append((now + self._link.delay, bytes(self._waiting[:count])))
            del self._waiting[:count]
        while self._travelling and self._travelling[0][0] <= now:
            self._take(self._travelling.popleft()[1], now)

    def _take(self, data: bytes, now: float) -> None:
        self.received += len(data)
        both = self._end + data
        self.frames += both.count(FRAME) - self._end.count(FRAME)
        self.frames_ended += both.count(FRAME_END) - self._end.count(FRAME_END)
        for question, answer in ANSWERS.items():
            for _ in range(both.count(question) - self._end.count(question)):
                self._typed.append((now + self._link.delay, answer))
        self._end = both[-16:]
        if self.screen:
            text = self._tail + self._decoder.decode(data)
            cut = CUT_OFF.search(text)
            whole = cut.start() if cut else len(text)
            self._tail = text[whole:]
            self.screen.feed(UNSHOWN.sub("", text[:whole]))


def _become(command: Sequence[str], size: tuple[int, int]) -> None:
    try:
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", size[1], size[0], 0, 0))
        environment = {k: v for k, v in os.environ.items() if k not in ("TMUX", "NO_COLOR", "LINES", "COLUMNS")}
        os.execvpe(command[0], command, {**environment, "TERM": "xterm-256color", "COLORTERM": "truecolor"})
    finally:
        os._exit(127)
