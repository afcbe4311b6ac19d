"""Threads of the runtime itself that take turns in a stepped run, such as one that waits for an alarm."""

from __future__ import annotations

import _thread
from collections.abc import Callable
from typing import TYPE_CHECKING

from ..node.thread_state import local

if TYPE_CHECKING:
    from .scheduler import ScheduledTask
    from .stepped_time import SteppedTime


def start_own_thread(clock: SteppedTime, program: Callable[[ScheduledTask], object]) -> ScheduledTask:
    """Call `program(task)` in a new thread that is ready to run; the watchdog of the run ignores the thread."""
    task = clock.task(None)

    def run() -> None:
        local.task, local.waits_on = task, clock
        task.lock.acquire()
        try:
            program(task)
        finally:
            task.leave()

    _thread.start_new_thread(run, ())  # `threading.Thread` would make it a thread of the calling node
    return task
