"""CPU time of launched processes, and whether a process's code kept running after it was killed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.process import ProcessState
from bot_console.runtime.process.node.running import running_process
from bot_console.tui.console.launch.vitals import Vitals
from bot_console.tui.session.embedded.system_vitals import SystemVitals

if TYPE_CHECKING:
    from bot_console.runtime.process.roles import RunningProcess


class NodeVitals:
    """The vitals of a node process: a thread of this process, and the threads it starts."""

    def __init__(self, process: RunningProcess) -> None:
        self._process = process

    def cpu_seconds(self) -> float | None:
        """CPU time (s) of its threads."""
        return self._process.cpu_seconds()

    def wanted_seconds(self) -> float | None:
        """Its CPU time: whether a thread waits for the interpreter or for something else is not known."""
        return self.cpu_seconds()

    def memory_bytes(self) -> int | None:
        """None: threads share their memory."""
        return None

    def is_stopped(self) -> bool:
        """Always false: no signal freezes a single thread."""
        return False

    def holds_lock_in(self) -> str:
        """Always empty: while the lock is held, nobody in this process can ask."""
        return ""

    def hangs_in(self) -> str:
        """Where its code still runs although it was killed, as the runtime's notice describes it."""
        process = self._process
        return process.notices[-1] if process.state is ProcessState.ABANDONED and process.notices else ""


def find_vitals(pid: int) -> Vitals:
    """The vitals of a process by its pid, whether it is a node process or not."""
    process = running_process(pid)
    return SystemVitals(pid) if process is None else NodeVitals(process)
