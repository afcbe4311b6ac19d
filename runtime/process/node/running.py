"""The running node processes, by synthetic pid."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakValueDictionary

if TYPE_CHECKING:
    from ..roles import RunningProcess

running: WeakValueDictionary[int, RunningProcess] = WeakValueDictionary()


def process_of_thread(ident: int) -> RunningProcess | None:
    """Return the running node process that a thread belongs to, or None."""
    processes = tuple(running.values())
    return next((each for each in processes if any(state.ident == ident for state in each.thread_states())), None)


def running_process(pid: int) -> RunningProcess | None:
    """Return the running node process with this synthetic pid, or None."""
    return running.get(pid)
