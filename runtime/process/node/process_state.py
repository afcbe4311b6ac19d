"""The state of a node process."""

from __future__ import annotations

from enum import Enum


class ProcessState(Enum):
    """The stages from its creation to its end, and beyond for a thread that does not end."""

    NEW = "new"
    RUNNING = "running"
    EXITED = "exited"
    ABANDONED = "abandoned"
    """Killed, but a thread of it still runs; it has left the graph and its output is discarded."""
