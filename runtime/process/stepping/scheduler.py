"""The scheduler of a stepped run. The thread with the turn runs; when it waits, it passes the turn on in a fixed order.

Threads run in the order in which they became ready. When none is ready, time jumps to the earliest deadline, and the
threads with that deadline become ready in order of creation.
"""

from __future__ import annotations

from _thread import allocate_lock, get_ident, get_native_id
from collections import deque
from contextlib import suppress
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, Protocol, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..clock_source import WaitingThread

LAST = 1 << 60
"""The driver's rank, the last one: it sees everything that happens up to the time until which it waits."""
POLL_NS = 20_000
"""Cost of a wait that would not block (ns), so that a polling loop advances time."""
INSTANT_WAITS = 50_000
"""Number of waits at one instant after which each further one costs `POLL_NS`, as nodes may keep waking each other."""
STALE_DEADLINES = 64
"""How many entries, beyond four per thread, the deadline queue may have before those of ended waits are removed."""
Note = TypeVar("Note")
SIGNAL_CHECK_S = 0.2
"""How often (s of wall time) a waiting driver checks for real signals, which another thread may have received."""


class Awaited(Protocol):
    """Something that threads wait for, as seen by the scheduler."""

    flag: bool
    """Whether it is set."""
    waiters: list[ScheduledTask]
    """The waiting tasks, in the order of their waits."""


class ScheduledTask:
    """One thread, as a task of the run."""

    __slots__ = (
        "detached",
        "due",
        "ident",
        "in_heap",
        "is_outside",
        "lock",
        "native_id",
        "rank",
        "scheduler",
        "state",
        "waiting",
        "wakeup",
        "woken",
    )

    def __init__(self, scheduler: Scheduler, rank: int, state: WaitingThread | None) -> None:
        self.scheduler = scheduler
        self.rank = rank
        self.state = state
        self.lock = allocate_lock()
        # Held from the start: to wait for the turn is to acquire it again, to grant the turn is to release it.
        self.lock.acquire()
        self.wakeup: Awaited | None = None
        self.due: int | None = None
        self.in_heap: int | None = None
        self.waiting = False
        self.woken = False
        self.detached = False
        self.is_outside = False
        self.ident = self.native_id = 0

    def take(self) -> None:
        """Wait for the first turn; called in the thread that this task represents."""
        self.native_id = get_native_id()
        self.ident = get_ident()
        self.lock.acquire()

    def hold_clock(self) -> None:
        """Stop the clock until this thread first waits, or ends."""
        self.scheduler.starting.add(self)

    def attach(self) -> None:
        """Let this thread, which was considered hung, run until it waits; called by the thread that has the turn."""
        self.scheduler.attach(self)

    def leave(self) -> None:
        """Leave the run and pass the turn on."""
        self.scheduler.leave(self)

    def wake_thread(self) -> None:
        """End the thread's current wait, although its wakeup is not set and its deadline not reached."""
        self.scheduler.wake_thread(self)

    def is_due_at(self, deadline: int) -> bool:
        """Whether its current wait ends at that time (ns) unless something ends it earlier."""
        return self.waiting and self.due == deadline

    def wait(self, wakeup: Awaited | None, deadline: int | None) -> bool:
        """Yield to other threads until woken or due (ns); return whether woken. Raises any pending exception."""
        state, scheduler = self.state, self.scheduler
        if state is None:
            return scheduler.wait(self, wakeup, deadline)
        while True:
            try:
                state.begin_wait(self.wake_thread)
                woken = scheduler.wait(self, wakeup, deadline)
            finally:
                state.end_wait()
            if state.called:
                state.deliver()
            if woken or (deadline is not None and scheduler.now >= deadline):
                return woken


class Scheduler:
    """Schedules the threads of a run: which one runs, which are ready, which wait for what, and the time (ns)."""

    def __init__(self, now: int) -> None:
        self.now = now
        self.holder: ScheduledTask | None = None
        self.turns = 0
        self.reads = 0
        self.tasks: dict[int, ScheduledTask] = {}
        self.starting: set[ScheduledTask] = set()
        """Threads that have not reached their first wait; the clock stands still until they do."""
        self._guard = allocate_lock()
        self._ready: deque[ScheduledTask] = deque()
        self._deadlines: list[tuple[int, int, ScheduledTask]] = []
        self._next_rank = 0
        self._instant_waits = 0

    def driver_task(self) -> ScheduledTask:
        """Return the task of a thread that has the turn from the start and may keep it as long as it likes."""
        self.holder = task = self.tasks[LAST] = ScheduledTask(self, LAST, None)
        return task

    def task(self, state: WaitingThread | None) -> ScheduledTask:
        """Return a task for a new thread, which is ready to run."""
        with self._guard:
            self._next_rank += 1
            task = self.tasks[self._next_rank] = ScheduledTask(self, self._next_rank, state)
            self._ready.append(task)
            if self.holder is None:
                self._grant_next()
        return task

    def leave(self, task: ScheduledTask) -> None:
        """Remove a thread that ends."""
        with self._guard:
            self.tasks.pop(task.rank, None)
            self.starting.discard(task)
            if self.holder is not task:
                with suppress(ValueError):
                    self._ready.remove(task)
            if self.holder is task or self.holder is None:
                self._grant_next()

    def wait(self, task: ScheduledTask, wakeup: Awaited | None, deadline: int | None) -> bool:
        """Pass the turn on; return True if the wakeup was set, False if the wait was due or ended otherwise."""
        with self._guard:
            self.turns += 1
            self._instant_waits += 1
            if self.starting:
                self.starting.discard(task)
            if self._instant_waits > INSTANT_WAITS:
                self.now += POLL_NS
            if wakeup is not None and wakeup.flag:
                # A wakeup that is already set costs no turn; but a thread whose wakeups always are would let nobody
                # else run.
                if not task.detached and self._instant_waits <= INSTANT_WAITS:
                    return True
                self._ready.append(task)
            elif deadline is not None and self._is_next(task, deadline):
                self.now = deadline
                self.reads = self._instant_waits = 0
                return False
            else:
                self._enlist(task, wakeup, deadline)
            waits = self._hand_on(task)
        if waits:
            self._await_turn(task)
        if task.waiting:
            self._withdraw(task, wakeup)
        return task.woken or (wakeup is not None and wakeup.flag)

    def _await_turn(self, task: ScheduledTask) -> None:
        try:
            if task.rank != LAST:
                task.lock.acquire()
            else:
                # A signal received by another thread does not end an `acquire` here, although its handler runs in
                # this thread.
                while not task.lock.acquire(True, SIGNAL_CHECK_S):
                    pass
        except BaseException:  # the handler of a real signal raised in the real main thread
            self._reclaim(task)
            raise

    def _is_next(self, task: ScheduledTask, deadline: int) -> bool:
        """Whether nothing happens before, or at the same time as, the end of the current thread's wait."""
        deadlines = self._deadlines
        return (
            not self._ready
            and self.now < deadline
            and (not deadlines or deadline < deadlines[0][0])
            and not (task.detached or self.starting or (task.state is not None and task.state.called))
        )

    def wait_outside(self, wakeup: Awaited, deadline: int | None) -> bool:
        """Wait in a thread that never has the turn, but runs beside the one that has it."""
        with self._guard:
            if wakeup.flag:
                return True
            self._next_rank += 1
            task = ScheduledTask(self, self._next_rank, None)
            task.is_outside = True
            self._enlist(task, wakeup, deadline)
            if self.holder is None:
                self._grant_next()
        try:
            task.lock.acquire()
        finally:
            with self._guard:
                if task.waiting:
                    self._withdraw(task, wakeup)
        return task.woken

    def wake_thread(self, task: ScheduledTask) -> None:
        """Make a waiting thread ready."""
        with self._guard:
            self._make_ready(task)
            if self.holder is None:
                self._grant_next()

    def wake_all_threads(self, wakeup: Awaited) -> None:
        """Set a wakeup: its waiters become ready, in the order of their waits."""
        with self._guard:
            wakeup.flag = True
            if wakeup.waiters:
                for task in tuple(wakeup.waiters):
                    task.woken = True
                    self._make_ready(task)
                if self.holder is None:
                    self._grant_next()

    def detach(self, task: ScheduledTask, turns: int, note: Callable[[ScheduledTask], Note]) -> Note | None:
        """Take the turn from a thread that blocks elsewhere, unless it has moved on since.

        Returns the result of `note`, called before the next thread runs; None if the thread has moved on.
        """
        with self._guard:
            if self.holder is not task or self.turns != turns:
                return None
            task.detached = True
            message = note(task)
            self._grant_next()
            return message

    def attach(self, task: ScheduledTask) -> None:
        """Pass the turn to a detached thread, as something has ended the call that it blocked in.

        Returns once the thread waits, or is detached again. Without effect if it has come back by itself.
        """
        with self._guard:
            holder = self.holder
            if holder is None or not task.detached:
                return
            task.detached = False
            self.turns += 1
            self._enlist(holder, None, self.now)
            self.holder = task
        self._await_turn(holder)

    def stop_waiting_for_starts(self) -> None:
        """Let time continue although some threads have not reached their first wait."""
        with self._guard:
            self.starting.clear()
            if self.holder is None:
                self._grant_next()

    def advance_to(self, time_ns: int) -> None:
        """Advance to a time at once, for a run whose time another process determines."""
        if time_ns > self.now:
            self.now = time_ns
            self.reads = self._instant_waits = 0

    def earliest_deadline(self) -> int | None:
        """Return the time (ns) at which the next thread other than the driver runs; None if there is no deadline."""
        with self._guard:
            if self._ready:
                return self.now
            due = (deadline for deadline, rank, task in self._deadlines if rank != LAST and task.is_due_at(deadline))
            return min(due, default=None)

    def horizon(self) -> int | None:
        """Return a time (ns) before which no thread but the current one runs; None if another one is ready."""
        return self._deadlines[0][0] if self._deadlines and not self._ready and not self.starting else None

    def _enlist(self, task: ScheduledTask, wakeup: Awaited | None, deadline: int | None) -> None:
        task.waiting = True
        task.woken = False
        task.wakeup = wakeup
        if wakeup is not None:
            wakeup.waiters.append(task)
        if deadline is None:
            task.due = None
        else:
            if deadline <= self.now and wakeup is not None:
                deadline = self.now + POLL_NS
            task.due = deadline
            if deadline != task.in_heap:
                task.in_heap = deadline
                heappush(self._deadlines, (deadline, task.rank, task))
        if task.state is not None and task.state.called:
            self._make_ready(task)

    def _make_ready(self, task: ScheduledTask) -> None:
        if not task.waiting:
            return
        task.waiting = False
        if task.wakeup is not None:
            task.wakeup.waiters.remove(task)
            task.wakeup = None
        if task.is_outside:
            task.lock.release()
        else:
            self._ready.append(task)

    def _withdraw(self, task: ScheduledTask, wakeup: Awaited | None) -> None:
        """Cancel a wait that was not ended by a wakeup."""
        task.waiting = False
        if wakeup is not None:
            wakeup.waiters.remove(task)

    def _next(self) -> ScheduledTask | None:
        """Return the thread whose turn it is, advancing time if none is ready."""
        ready, deadlines = self._ready, self._deadlines
        while deadlines and (not ready or deadlines[0][0] <= self.now):
            deadline, rank, task = deadlines[0]
            if task.waiting and task.due == deadline:
                # The driver runs after all other threads that are ready at this instant.
                if rank == LAST and ready and deadline == self.now:
                    break
                if deadline > self.now:
                    # The wall time that a start takes must not decide what happens before its end.
                    if self.starting:
                        break
                    self.now = deadline
                    self.reads = self._instant_waits = 0
                self._make_ready(task)
            # Woken before it was due, or served now: either way this entry is finished.
            heappop(deadlines)
            if task.in_heap == deadline:
                task.in_heap = None
        return ready.popleft() if ready else None

    def _grant_next(self) -> None:
        self.holder = task = self._next()
        if task is not None:
            task.lock.release()

    def _hand_on(self, task: ScheduledTask) -> bool:
        """Let the next thread run; return whether `task` has to wait for its turn."""
        if len(self._deadlines) > STALE_DEADLINES + 4 * len(self.tasks):
            self._drop_stale_deadlines()
        if task.detached:
            # It was considered hung, and another thread may have the turn by now.
            task.detached = False
            if self.holder is not None:
                return True
        self.holder = following = self._next()
        if following is task:
            return False
        if following is not None:
            following.lock.release()
        return True

    def _drop_stale_deadlines(self) -> None:
        live = {entry for entry in self._deadlines if entry[2].waiting and entry[2].due == entry[0]}
        for _deadline, _rank, task in self._deadlines:
            task.in_heap = None
        self._deadlines[:] = live
        for deadline, _rank, task in self._deadlines:
            task.in_heap = deadline
        heapify(self._deadlines)

    def _reclaim(self, task: ScheduledTask) -> None:
        """Get the turn back before anything else runs, for a thread that no longer waits."""
        with self._guard:
            if self.holder is not task:
                self._make_ready(task)
                with suppress(ValueError):
                    self._ready.remove(task)
                self._ready.appendleft(task)
                if self.holder is None:
                    self._grant_next()
        while self.holder is not task:
            with suppress(KeyboardInterrupt):
                if task.lock.acquire(timeout=1.0):
                    return
        # A turn granted meanwhile would make the next wait return at once.
        task.lock.acquire(False)
