"""Stepped time: a run in which exactly one thread runs at a time, and time jumps when all of them wait."""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from typing import Any

from .. import stack_frames
from ..clock_source import WaitingThread
from ..current import MAIN
from ..node.signals import SIGKILL
from ..node.thread_state import ThreadState, local
from ..notices import notify
from ..virtual.install import install_virtual_process
from ..watch.stepped_stall import StallWatch
from .calls import install_stepped_calls, uninstall_stepped_calls
from .one_cpu import pin_thread
from .scheduler import ScheduledTask, Scheduler
from .wakeup import SteppedWakeup

DEFAULT_START_NS = 1_700_000_000_000_000_000
"""Default system time (ns since the epoch) at which a stepped run begins."""
FREE_READS = 10_000
"""Number of clock readings at one instant that are free; each further one costs `READ_NS`, for busy-waiting loops."""
READ_NS = 1_000
_SO = "so that others run beside it and the run is not deterministic"
BLOCKS = f"waits for something outside the stepped run, {_SO}. Wait with time.sleep, rclpy or threading instead"
COMPUTES = f"has computed for long without waiting, {_SO}. Let it spin, sleep or wait in its loop"


class SteppedTime:
    """A clock source whose time only the run advances. The thread that creates it is the driver and has the first turn.

    Between two `run_*` calls only the driver runs. While it waits in the run (`run_*`, a wakeup, a sleep) the others
    take turns. `close` ends all threads of the run.
    """

    stepped = True

    def __init__(self, start_system_ns: int = DEFAULT_START_NS, *, stall_s: float = 1.0) -> None:
        self.deterministic = True
        self.stalls: list[str] = []
        self.system_offset = start_system_ns
        self.stall_s = stall_s
        self._scheduler = Scheduler(0)
        self._watch = StallWatch(self._scheduler, stall_s, self._report_stall)
        self._driver = self._scheduler.driver_task()
        self._previous_task, local.task = local.task, self._driver
        self._unpin = pin_thread()
        install_stepped_calls()

    def steady_ns(self) -> int:
        """Virtual time since the start of the run in ns."""
        scheduler = self._scheduler
        scheduler.reads += 1
        if scheduler.reads > FREE_READS:
            scheduler.now += READ_NS
        return scheduler.now

    def system_ns(self) -> int:
        """Virtual time since the epoch in ns."""
        scheduler = self._scheduler
        scheduler.reads += 1
        if scheduler.reads > FREE_READS:
            scheduler.now += READ_NS
        return scheduler.now + self.system_offset

    def wakeup(self) -> SteppedWakeup:
        """Return a new, unset wakeup."""
        return SteppedWakeup(self._scheduler)

    def sleep_until(self, deadline_ns: int) -> None:
        """Let other threads run until virtual steady time reaches the deadline (ns)."""
        SteppedWakeup(self._scheduler).wait(deadline_ns)

    def advance_to(self, steady_ns: int) -> None:
        """Advance to that steady time (ns) at once, unless it is already past."""
        self._scheduler.advance_to(steady_ns)

    def earliest_deadline(self) -> int | None:
        """Return the steady time (ns) at which the next thread but the driver runs; None if all wait for others."""
        return self._scheduler.earliest_deadline()

    def add_stalls(self, stalls: Sequence[str]) -> None:
        """Add lines in which threads blocked, reported by a process that takes part in the run."""
        if stalls:
            self.deterministic = False
            self.stalls += stalls

    def task(self, thread: WaitingThread | None) -> ScheduledTask:
        """Return a task for a new thread, which is ready to run."""
        self._watch.start()
        return self._scheduler.task(thread)

    def run_until(self, steady_ns: int) -> None:
        """Run everything up to and including that steady time (ns). Raises `RuntimeError` outside the run."""
        task = local.task
        if not isinstance(task, ScheduledTask) or task.scheduler is not self._scheduler:
            raise RuntimeError("this thread takes no part in the stepped run")
        self._scheduler.wait(task, None, steady_ns)

    def run_for(self, seconds: float) -> None:
        """Run everything in the next `seconds` s of virtual time."""
        self.run_until(self._scheduler.now + round(seconds * 1e9))

    def close(self) -> None:
        """Kill the threads that still run, let them unwind, and restore the driver's thread."""
        for task in tuple(self._scheduler.tasks.values()):
            if isinstance(task.state, ThreadState):
                task.state.process.die(-SIGKILL)
                task.state.kill()
        self.run_until(self._scheduler.now)
        self._driver.leave()
        local.task = self._previous_task
        self._unpin()
        uninstall_stepped_calls()

    def _report_stall(self, task: ScheduledTask, busy: bool) -> Callable[[], None]:
        line = stack_frames.thread_line(task.ident)
        process = task.state.process if isinstance(task.state, ThreadState) else MAIN
        self.add_stalls([f"{process.name}: {line}"])
        return lambda: notify(process, f"{line} {COMPUTES if busy else BLOCKS}")


@contextmanager
def stepped(
    start_system_ns: int = DEFAULT_START_NS, *, seed: int = 0, virtual_main: bool = True, stall_s: float = 1.0
) -> Generator[SteppedTime]:
    """Run the block in stepped time, driven by the calling thread, with `random` and `numpy.random` started from
    `seed`.

    It applies to `MAIN` and the calling thread. If `virtual_main` is true, the calling thread is treated like a node's:
    its `time` module, sleeps, waits and new threads belong to the run. Otherwise only its clock queries do, which suits
    an asyncio loop or a user interface.
    """
    install_virtual_process()
    clock = SteppedTime(start_system_ns, stall_s=stall_s)
    before = MAIN.clock, local.waits_on
    MAIN.clock = clock
    local.waits_on = clock if virtual_main else None
    try:
        with _random_seed(seed):
            yield clock
    finally:
        clock.close()
        MAIN.clock, local.waits_on = before


@contextmanager
def _random_seed(seed: int) -> Generator[None]:
    before = random.getstate()
    random.seed(seed)
    numpy_random: Any = sys.modules.get("numpy.random")
    numpy_before = None if numpy_random is None else numpy_random.get_state()
    if numpy_random is not None:
        numpy_random.seed(seed % (1 << 32))
    try:
        yield
    finally:
        random.setstate(before)
        if numpy_random is not None:
            numpy_random.set_state(numpy_before)
