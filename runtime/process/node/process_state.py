"""The state of a node process."""

from __future__ import annotations

from enum import Enum


class ProcessState(Enum):
    """The stages of a process from creation to end, and beyond if one of its threads does not end."""

    NEW = "new"
    RUNNING = "running"
    EXITED = "exited"
    ABANDONED = "abandoned"
    """Killed, but one of its threads still runs; it has left the graph and its output is discarded."""
