"""A file in the domain's folder for each process that is stopped in a debugger, so that other processes can report it.

Such a process is alive and linked, but its nodes may answer nothing; only the process itself knows why.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping

from bot_console.runtime.process.unpatched import getpid
from bot_console.runtime.process.watch.debugger import line_in_debugger
from bot_console.runtime.rmw.zenoh.domain.folder import names_in

SUFFIX = ".debugger"


def update_note(folder: str) -> None:
    """Write this process's file if a debugger has stopped it, otherwise remove it."""
    line = line_in_debugger()
    if line is None:
        remove_note(folder, getpid())
    elif line != debugger_line(folder, getpid()):
        with open(_path(folder, getpid()), "w", encoding="utf-8", errors="surrogateescape") as file:
            file.write(line)


def remove_note(folder: str, pid: int) -> None:
    """Remove the file of a process, if there is one."""
    with contextlib.suppress(OSError):
        os.unlink(_path(folder, pid))


def debugger_line(folder: str, pid: int) -> str | None:
    """Return the line at which a debugger has stopped a process, empty if unknown; None if it is not stopped."""
    try:
        with open(_path(folder, pid), encoding="utf-8", errors="surrogateescape") as file:
            return file.read()
    except OSError:
        return None


def debugger_lines(folder: str) -> Mapping[int, str]:
    """Return the lines of all stopped processes by pid."""
    pids = [name.removesuffix(SUFFIX) for name in names_in(folder) if name.endswith(SUFFIX)]
    found = {int(each): debugger_line(folder, int(each)) for each in pids if each.isascii() and each.isdecimal()}
    return {pid: line for pid, line in found.items() if line is not None}


def _path(folder: str, pid: int) -> str:
    return os.path.join(folder, f"{pid}{SUFFIX}")
