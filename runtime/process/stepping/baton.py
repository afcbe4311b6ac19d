"""The scheduler of a stepped run. The thread with the baton runs; when it waits, it hands it on in a fixed order.

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
"""The driver's rank, the last: it sees everything that happens up to the time until which it waits."""
POLL_NS = 20_000
"""Cost of a wait that would not block (ns), so that a polling loop advances time."""
INSTANT_WAITS = 50_000
"""Number of waits at one instant after which each costs `POLL_NS`: nodes may keep waking each other for ever."""
STALE_DEADLINES = 64
Note = TypeVar("Note")
SIGNAL_CHECK_S = 0.2
"""How often (s of wall time) a waiting driver checks for real signals: another thread may have received them."""


class Awaited(Protocol):
    """What threads wait for, as seen by the scheduler."""

    flag: bool
    """Whether it is set."""
    waiters: list[Seat]
    """In the order of their waits."""


class Seat:
    """One thread's seat in the run."""

    __slots__ = (
        "baton",
        "detached",
        "due",
        "ident",
        "in_heap",
        "is_outside",
        "lock",
        "native_id",
        "rank",
        "state",
        "waiting",
        "wakeup",
        "woken",
    )

    def __init__(self, baton: Baton, rank: int, state: WaitingThread | None) -> None:
        self.baton = baton
        self.rank = rank
        self.state = state
        self.lock = allocate_lock()
        # Held from the start: waiting for the turn is acquiring it again, granting the turn is releasing it.
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
        """Wait for the first turn; called in the thread that occupies this seat from now on."""
        self.native_id = get_native_id()
        self.ident = get_ident()
        self.lock.acquire()

    def hold_clock(self) -> None:
        """Stop the clock until this thread first waits, or ends."""
        self.baton.starting.add(self)

    def leave(self) -> None:
        """Leave the run and pass the turn on."""
        self.baton.leave(self)

    def rouse(self) -> None:
        """End the thread's present wait though it is neither set nor due."""
        self.baton.rouse(self)

    def wait(self, wakeup: Awaited | None, deadline: int | None) -> bool:
        """Hand the baton on until woken or due (ns); return whether woken. Raises what is pending for this thread."""
        state, baton = self.state, self.baton
        if state is None:
            return baton.wait(self, wakeup, deadline)
        while True:
            try:
                state.begin_wait(self.rouse)
                woken = baton.wait(self, wakeup, deadline)
            finally:
                state.end_wait()
            if state.called:
                state.deliver()
            if woken or (deadline is not None and baton.now >= deadline):
                return woken


class Baton:
    """The scheduler: which thread runs, which are ready, which wait for what (the deadline queue), the time (ns)."""

    def __init__(self, now: int) -> None:
        self.now = now
        self.holder: Seat | None = None
        self.turns = 0
        self.reads = 0
        self.seats: dict[int, Seat] = {}
        self.starting: set[Seat] = set()
        """Threads that have not reached their first wait and stop the clock until then."""
        self._guard = allocate_lock()
        self._ready: deque[Seat] = deque()
        self._deadlines: list[tuple[int, int, Seat]] = []
        self._next_rank = 0
        self._instant_waits = 0

    def driver_seat(self) -> Seat:
        """Return the seat of a thread that has the baton from the start and may keep it as long as it likes."""
        self.holder = seat = self.seats[LAST] = Seat(self, LAST, None)
        return seat

    def seat(self, state: WaitingThread | None) -> Seat:
        """Return a seat for a new thread, which is ready to run."""
        with self._guard:
            self._next_rank += 1
            seat = self.seats[self._next_rank] = Seat(self, self._next_rank, state)
            self._ready.append(seat)
            if self.holder is None:
                self._grant_next()
        return seat

    def leave(self, seat: Seat) -> None:
        """Remove a thread that ends."""
        with self._guard:
            self.seats.pop(seat.rank, None)
            self.starting.discard(seat)
            if self.holder is not seat:
                with suppress(ValueError):
                    self._ready.remove(seat)
            if self.holder is seat or self.holder is None:
                self._grant_next()

    def wait(self, seat: Seat, wakeup: Awaited | None, deadline: int | None) -> bool:
        """Hand the baton on; return True if the wakeup was set, False if due or roused."""
        with self._guard:
            self.turns += 1
            self._instant_waits += 1
            if self.starting:
                self.starting.discard(seat)
            if self._instant_waits > INSTANT_WAITS:
                self.now += POLL_NS
            if wakeup is not None and wakeup.flag:
                # A wakeup that is already set costs no turn; but a thread that only waited for such would let nobody
                # else run.
                if not seat.detached and self._instant_waits <= INSTANT_WAITS:
                    return True
                self._ready.append(seat)
            elif deadline is not None and self._is_next(seat, deadline):
                self.now = deadline
                self.reads = self._instant_waits = 0
                return False
            else:
                self._enlist(seat, wakeup, deadline)
            waits = self._hand_on(seat)
        if waits:
            try:
                if seat.rank != LAST:
                    seat.lock.acquire()
                else:
                    # A signal received by another thread does not end an acquire here, though its handler runs in this
                    # thread.
                    while not seat.lock.acquire(True, SIGNAL_CHECK_S):
                        pass
            except BaseException:  # a real signal's handler raised in the real main thread
                self._reclaim(seat)
                raise
        if seat.waiting:
            self._withdraw(seat, wakeup)
        return seat.woken or (wakeup is not None and wakeup.flag)

    def _is_next(self, seat: Seat, deadline: int) -> bool:
        """Whether nothing happens before, or at the same time as, the end of the holder's wait."""
        deadlines = self._deadlines
        return (
            not self._ready
            and self.now < deadline
            and (not deadlines or deadline < deadlines[0][0])
            and not (seat.detached or self.starting or (seat.state is not None and seat.state.called))
        )

    def wait_outside(self, wakeup: Awaited, deadline: int | None) -> bool:
        """Wait in a thread that never has the baton and runs beside the one that does."""
        with self._guard:
            if wakeup.flag:
                return True
            self._next_rank += 1
            seat = Seat(self, self._next_rank, None)
            seat.is_outside = True
            self._enlist(seat, wakeup, deadline)
            if self.holder is None:
                self._grant_next()
        try:
            seat.lock.acquire()
        finally:
            with self._guard:
                if seat.waiting:
                    self._withdraw(seat, wakeup)
        return seat.woken

    def rouse(self, seat: Seat) -> None:
        """Make a waiting thread ready."""
        with self._guard:
            self._make_ready(seat)
            if self.holder is None:
                self._grant_next()

    def rouse_all(self, wakeup: Awaited) -> None:
        """Set a wakeup: its waiters become ready, in the order of their waits."""
        with self._guard:
            wakeup.flag = True
            if wakeup.waiters:
                for seat in tuple(wakeup.waiters):
                    seat.woken = True
                    self._make_ready(seat)
                if self.holder is None:
                    self._grant_next()

    def detach(self, seat: Seat, turns: int, note: Callable[[Seat], Note]) -> Note | None:
        """Take the baton from a thread that blocks elsewhere, unless it has moved on since.

        Returns the result of `note`, called before the next thread runs; None if the thread has moved on.
        """
        with self._guard:
            if self.holder is not seat or self.turns != turns:
                return None
            seat.detached = True
            said = note(seat)
            self._grant_next()
            return said

    def stop_waiting_for_starts(self) -> None:
        """Let time go on although some threads have not reached their first wait."""
        with self._guard:
            self.starting.clear()
            if self.holder is None:
                self._grant_next()

    def _enlist(self, seat: Seat, wakeup: Awaited | None, deadline: int | None) -> None:
        seat.waiting = True
        seat.woken = False
        seat.wakeup = wakeup
        if wakeup is not None:
            wakeup.waiters.append(seat)
        if deadline is None:
            seat.due = None
        else:
            if deadline <= self.now and wakeup is not None:
                deadline = self.now + POLL_NS
            seat.due = deadline
            if deadline != seat.in_heap:
                seat.in_heap = deadline
                heappush(self._deadlines, (deadline, seat.rank, seat))
        if seat.state is not None and seat.state.called:
            self._make_ready(seat)

    def _make_ready(self, seat: Seat) -> None:
        if not seat.waiting:
            return
        seat.waiting = False
        if seat.wakeup is not None:
            seat.wakeup.waiters.remove(seat)
            seat.wakeup = None
        if seat.is_outside:
            seat.lock.release()
        else:
            self._ready.append(seat)

    def _withdraw(self, seat: Seat, wakeup: Awaited | None) -> None:
        """Cancel a wait that was not ended by a wakeup."""
        seat.waiting = False
        if wakeup is not None:
            wakeup.waiters.remove(seat)

    def _next(self) -> Seat | None:
        """Return the thread whose turn it is, advancing time if none is ready."""
        ready, deadlines = self._ready, self._deadlines
        while deadlines and (not ready or deadlines[0][0] <= self.now):
            deadline, rank, seat = deadlines[0]
            if seat.waiting and seat.due == deadline:
                # The driver comes after all others that are ready at this instant.
                if rank == LAST and ready and deadline == self.now:
                    break
                if deadline > self.now:
                    # The wall time that a start takes must not decide what happens before it.
                    if self.starting:
                        break
                    self.now = deadline
                    self.reads = self._instant_waits = 0
                self._make_ready(seat)
            # Woken before it was due, or served now: either way this entry is done.
            heappop(deadlines)
            if seat.in_heap == deadline:
                seat.in_heap = None
        return ready.popleft() if ready else None

    def _grant_next(self) -> None:
        self.holder = seat = self._next()
        if seat is not None:
            seat.lock.release()

    def _hand_on(self, seat: Seat) -> bool:
        """Let the next thread run; return whether `seat` has to wait for its turn."""
        if len(self._deadlines) > STALE_DEADLINES + 4 * len(self.seats):
            self._drop_stale_deadlines()
        if seat.detached:
            # It was considered hung, and another thread may have the baton by now.
            seat.detached = False
            if self.holder is not None:
                return True
        self.holder = following = self._next()
        if following is seat:
            return False
        if following is not None:
            following.lock.release()
        return True

    def _drop_stale_deadlines(self) -> None:
        live = {entry for entry in self._deadlines if entry[2].waiting and entry[2].due == entry[0]}
        for _deadline, _rank, seat in self._deadlines:
            seat.in_heap = None
        self._deadlines[:] = live
        for deadline, _rank, seat in self._deadlines:
            seat.in_heap = deadline
        heapify(self._deadlines)

    def _reclaim(self, seat: Seat) -> None:
        """Get the baton back before anything else runs, for a thread that no longer waits."""
        with self._guard:
            if self.holder is not seat:
                self._make_ready(seat)
                with suppress(ValueError):
                    self._ready.remove(seat)
                self._ready.appendleft(seat)
                if self.holder is None:
                    self._grant_next()
        while self.holder is not seat:
            with suppress(KeyboardInterrupt):
                if seat.lock.acquire(timeout=1.0):
                    return
        # A turn granted meanwhile would make the next wait return at once.
        seat.lock.acquire(False)
