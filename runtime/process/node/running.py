"""The running node processes, by synthetic pid."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakValueDictionary

if TYPE_CHECKING:
    from ..roles import RunningProcess

running: WeakValueDictionary[int, RunningProcess] = WeakValueDictionary()


def running_process(pid: int) -> RunningProcess | None:
    """Return the running node process with this synthetic pid, or None."""
    return running.get(pid)
