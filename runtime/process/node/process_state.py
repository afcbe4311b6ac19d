"""The state of a node process."""

from __future__ import annotations

from enum import Enum


class ProcessState(Enum):
    """From its making to its end; what becomes of its code after that."""

    NEW = "new"
    RUNNING = "running"
    EXITED = "exited"
    ABANDONED = "abandoned"
    """Killed, but a thread of it still runs; it has left the graph and its output is dropped."""
