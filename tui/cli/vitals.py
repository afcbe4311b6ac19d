"""Processor time of launched processes, and whether code of one has survived being killed."""

from __future__ import annotations

import os
from pathlib import Path

from bot_console.runtime.process import NodeProcess, ProcessState
from bot_console.runtime.process.node_process import running_process
from bot_console.tui.console.launch.vitals import Vitals


class NodeVitals:
    """Those of a node process, which is a thread of this process and those that it starts."""

    def __init__(self, process: NodeProcess) -> None:
        self._process = process

    def cpu_seconds(self) -> float | None:
        """Processor time (s) of its threads."""
        return self._process.cpu_seconds()

    def memory_bytes(self) -> int | None:
        """None: threads share their memory."""
        return None

    def hangs_in(self) -> str:
        """Where code of it still is although it was killed, as the runtime's notice says it."""
        process = self._process
        return process.notices[-1] if process.state is ProcessState.ABANDONED and process.notices else ""


class SystemVitals:
    """Those of a process of the system; without `/proc` nothing is known."""

    def __init__(self, pid: int) -> None:
        self._stat = Path(f"/proc/{pid}/stat")
        self._statm = Path(f"/proc/{pid}/statm")

    def cpu_seconds(self) -> float | None:
        """Processor time (s) of the process."""
        try:
            fields = self._stat.read_bytes().rpartition(b")")[2].split()
        except OSError:  # it has ended, or the system has no such file
            return None
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def memory_bytes(self) -> int | None:
        """What `top` calls RES: with what it shares with the fork server, if that has started it."""
        try:
            return int(self._statm.read_bytes().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        except OSError:
            return None

    def hangs_in(self) -> str:
        """Nothing survives a SIGKILL here."""
        return ""


def find_vitals(pid: int) -> Vitals:
    """The vitals of a process by its pid, node process or not."""
    process = running_process(pid)
    return SystemVitals(pid) if process is None else NodeVitals(process)
