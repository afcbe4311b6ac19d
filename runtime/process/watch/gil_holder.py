"""Detect from outside that a process hangs because C code holds the GIL, and name the line."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from typing import NamedTuple

from .. import stack_frames, unpatched

NAME = "interpreter-stacks"
"""Name of a watched process's in-memory file."""
MIN_SWITCHES_PER_S = 4
"""Minimum number of times per second that a thread waiting for the GIL wakes: every 5 ms unless the machine is busy. A
thread that only waits for a processor, or is frozen, does not wake.
"""
MAX_FILE_CHECKS = 20
"""How many checks in a row may miss the file of a process that has just started."""

_HEADER = re.compile(r"(\d+) (\d+) ([\d.]+)\n")
_THREAD = re.compile(r"Thread 0x([0-9a-f]+)")
_FRAME = re.compile(r'  File "(.*)", line (\d+) in (.*)')
_ESCAPE = re.compile(r"\\(?:x[0-9a-f]{2}|u[0-9a-f]{4}|U[0-9a-f]{8})")


class HoldingThread(NamedTuple):
    """The thread that holds the GIL."""

    ident: int
    """The thread's id, as from `threading.get_ident`."""
    line: str
    """`/path/file.py:12, in function`; if two lines cannot be told apart, both, joined by ` or `."""


@dataclass
class _Thread:
    ident: int
    stack: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    """File and description of each frame, the innermost first."""


def voluntary_switches(process: int | str, thread: int) -> int | None:
    """Return a thread's number of voluntary context switches; None if the system does not tell."""
    try:
        with open(f"/proc/{process}/task/{thread}/status", "rb") as file:
            return int(file.read().partition(b"\nvoluntary_ctxt_switches:")[2].split(maxsplit=1)[0])
    except (OSError, ValueError, IndexError):  # the process has ended, or the system has no such file
        return None


def holding_thread(text: str, switches: int, now: float) -> HoldingThread | None:
    """Determine from a watched process's file which thread holds the GIL, if any.

    `switches` are the voluntary switches of the thread named in the file; `now` is the monotonic time in s.
    """
    header = _HEADER.match(text)
    if header is None or header.end() == len(text):
        return None
    woken, passed = switches - int(header[2]), now - float(header[3])
    if woken < MIN_SWITCHES_PER_S * passed:
        return None
    at_work = [
        each for each in _threads(text[header.end() :]) if each.stack and not stack_frames.is_idle(each.stack[0][0])
    ]
    if any(file.startswith("<frozen importlib") for each in at_work for file, _ in each.stack):
        return None
    found = [(each.ident, *where) for each in at_work if (where := _line_of_user(each)) is not None]
    found = [each for each in found if not stack_frames.is_shipped(each[1])] or found
    if not found:
        return None
    return HoldingThread(found[0][0], " or ".join(dict.fromkeys(line for *_, line in found[:2])))


def _threads(text: str) -> list[_Thread]:
    threads: list[_Thread] = []
    for line in text.splitlines():
        if begun := _THREAD.match(line):
            threads.append(_Thread(int(begun[1], 16)))
        elif threads and (frame := _FRAME.match(line)):
            file = _ESCAPE.sub(lambda found: found[0].encode().decode("unicode_escape"), frame[1])
            threads[-1].stack.append((file, f"{file}:{frame[2]}, in {frame[3]}"))
    return threads


def _line_of_user(thread: _Thread) -> tuple[str, str] | None:
    return next((each for each in thread.stack if not stack_frames.is_library(each[0])), None)


class GilHolder:
    """Checks one process repeatedly."""

    def __init__(self, pid: int) -> None:
        self._pid = pid
        self._path = ""
        self._file_checks = 0

    def held_in(self) -> str:
        """Return the line in which its GIL is held; empty if it is not held, or unknown."""
        if not self._path and self._file_checks < MAX_FILE_CHECKS:
            self._file_checks += 1
            self._path = _file_of(self._pid)
        if not self._path:
            return ""
        text = _content(self._path)
        if text is None:
            self._path = ""  # the file was moved to another descriptor, unless the process has ended
            return ""
        thread = text.partition(" ")[0]
        switches = voluntary_switches(self._pid, int(thread)) if thread.isdecimal() else None
        held = None if switches is None else holding_thread(text, switches, unpatched.monotonic())
        return held.line if held is not None else ""


def _content(path: str) -> str | None:
    """Return what a process has written to its file; None if there is no such file at that descriptor.

    The process may have closed the descriptor and opened something else under its number; reading from a pipe could
    block.
    """
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        with open(descriptor, encoding="ascii", errors="replace") as file:
            return file.read(1 << 20) if _is_stacks(f"/proc/self/fd/{descriptor}") else None
    except OSError:  # the process has ended, or closed its file
        return None


def _is_stacks(path: str) -> bool:
    return f":{NAME}" in os.readlink(path)


def _file_of(pid: int) -> str:
    folder = f"/proc/{pid}/fd"
    try:
        for name in os.listdir(folder):
            if _is_stacks(f"{folder}/{name}"):
                return f"{folder}/{name}"
    except OSError:  # the process has ended or is another user's, or the system has no such folder
        return ""
    return ""
