"""Processor time of launched processes, and whether code of one has survived being killed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.process import ProcessState
from bot_console.runtime.process.node.running import running_process
from bot_console.tui.cli.live.system_vitals import SystemVitals
from bot_console.tui.console.launch.vitals import Vitals

if TYPE_CHECKING:
    from bot_console.runtime.process.roles import RunningProcess


class NodeVitals:
    """Those of a node process, which is a thread of this process and those that it starts."""

    def __init__(self, process: RunningProcess) -> None:
        self._process = process

    def cpu_seconds(self) -> float | None:
        """Processor time (s) of its threads."""
        return self._process.cpu_seconds()

    def wanted_seconds(self) -> float | None:
        """Its processor time: a thread that waits for the interpreter cannot be told from one that waits."""
        return self.cpu_seconds()

    def memory_bytes(self) -> int | None:
        """None: threads share their memory."""
        return None

    def is_stopped(self) -> bool:
        """Never: no signal freezes a thread alone."""
        return False

    def holds_lock_in(self) -> str:
        """Never: while it does, nobody here can ask."""
        return ""

    def hangs_in(self) -> str:
        """Where code of it still is although it was killed, as the runtime's notice says it."""
        process = self._process
        return process.notices[-1] if process.state is ProcessState.ABANDONED and process.notices else ""


def find_vitals(pid: int) -> Vitals:
    """The vitals of a process by its pid, node process or not."""
    process = running_process(pid)
    return SystemVitals(pid) if process is None else NodeVitals(process)
