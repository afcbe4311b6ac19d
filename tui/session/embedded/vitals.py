"""The vitals of launched processes: CPU time, memory, hangs, and code that keeps running after it was killed."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from bot_console.runtime.process import ProcessState
from bot_console.runtime.process.node.running import running_process
from bot_console.runtime.process.watch.gil_holder import GilHolder
from bot_console.runtime.process.watch.processor_time import wanted_seconds
from bot_console.tui.console.launch.vitals import Vitals
from bot_console.tui.session.embedded.domain import line_in_debugger

if TYPE_CHECKING:
    from bot_console.runtime.process.roles import RunningProcess


class SystemVitals:
    """The vitals of an operating system process; nothing is known without `/proc`."""

    def __init__(self, pid: int) -> None:
        self._pid = pid
        self._lock = GilHolder(pid)
        self._stat = Path(f"/proc/{pid}/stat")
        self._statm = Path(f"/proc/{pid}/statm")

    def cpu_seconds(self) -> float | None:
        """The CPU time (s) of the process; None if it has ended."""
        try:
            fields = self._stat.read_bytes().rpartition(b")")[2].split()
        except OSError:  # the process has ended, or the system has no such file
            return None
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def wanted_seconds(self) -> float | None:
        """How long (s) its main thread has run or waited only for a CPU."""
        return wanted_seconds(str(self._pid))

    def memory_bytes(self) -> int | None:
        """The resident memory, like RES in `top`: includes memory shared with the fork server, if that started it."""
        try:
            return int(self._statm.read_bytes().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        except OSError:
            return None

    def is_stopped(self) -> bool:
        """Whether it is frozen."""
        try:
            return self._stat.read_bytes().rpartition(b")")[2].split()[0] in (b"T", b"t")
        except (OSError, IndexError):
            return False

    def line_in_debugger(self) -> str | None:
        """The line at which its nodes are stopped in a debugger, if it is in the domain of this process."""
        return line_in_debugger(self._pid)

    def holds_lock_in(self) -> str:
        """The line of code that holds its interpreter lock; empty if none does."""
        return self._lock.held_in()

    def hangs_in(self) -> str:
        """Always empty: nothing survives a SIGKILL here."""
        return ""


class NodeVitals:
    """The vitals of a node process, that is, a thread of this process and the threads that it starts."""

    def __init__(self, process: RunningProcess) -> None:
        self._process = process

    def cpu_seconds(self) -> float | None:
        """The CPU time (s) of its threads."""
        return self._process.cpu_seconds()

    def wanted_seconds(self) -> float | None:
        """Its CPU time, since it is unknown whether a thread waits for the interpreter or for something else."""
        return self.cpu_seconds()

    def memory_bytes(self) -> int | None:
        """Always None: threads share their memory."""
        return None

    def is_stopped(self) -> bool:
        """Always false: no signal freezes a single thread."""
        return False

    def line_in_debugger(self) -> None:
        """Always None: a debugger would stop this whole process."""

    def holds_lock_in(self) -> str:
        """Always empty: while the lock is held, no code in this process can ask."""
        return ""

    def hangs_in(self) -> str:
        """Where its code still runs although it was killed, in the words of the runtime's notice."""
        process = self._process
        return process.notices[-1] if process.state is ProcessState.ABANDONED and process.notices else ""


def find_vitals(pid: int) -> Vitals:
    """The vitals of a process by its pid, whether it is a node process or not."""
    process = running_process(pid)
    return SystemVitals(pid) if process is None else NodeVitals(process)
