"""The scheduler of a stepped run. One thread has the baton and runs; who waits hands it on, in a fixed order.

Threads run in the order in which they became ready. When none is, time jumps to the earliest deadline, and those whose
deadline that is become ready in the order in which they were made.
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
"""The driver's rank: it sees everything that happens at the time until which it waits."""
POLL_NS = 20_000
"""What a wait costs that would not block (ns), so that a loop of polls does not stand still in time."""
INSTANT_WAITS = 50_000
"""How many waits may happen at one instant before each costs `POLL_NS`: nodes may keep each other awake for ever."""
STALE_DEADLINES = 64
Note = TypeVar("Note")
SIGNAL_CHECK_S = 0.2
"""How often (s of wall time) a waiting driver looks for real signals: another thread may have received them."""


class Awaited(Protocol):
    """What threads wait for, as the scheduler sees it."""

    flag: bool
    """Whether it is set."""
    waiters: list[Seat]
    """In the order of their waits."""


class Seat:
    """One thread's place in the run."""

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
        # Held from the start: to wait for the turn is to acquire it again, to be given the turn is its release.
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
        """Wait for the first turn, in the thread that has this place from now on."""
        self.native_id = get_native_id()
        self.ident = get_ident()
        self.lock.acquire()

    def hold_clock(self) -> None:
        """Let time stand still until the first wait, or the end, of this thread."""
        self.baton.starting.add(self)

    def leave(self) -> None:
        """Take no more turns; the next one has it."""
        self.baton.leave(self)

    def rouse(self) -> None:
        """End the present wait of this thread, though neither set nor due."""
        self.baton.rouse(self)

    def wait(self, wakeup: Awaited | None, deadline: int | None) -> bool:
        """Hand the baton on until woken or due (ns); whether woken. Raises what is to be raised in this thread."""
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
    """The scheduler: who runs, who is ready, who waits for what (its deadline queue), and what time it is (ns)."""

    def __init__(self, now: int) -> None:
        self.now = now
        self.holder: Seat | None = None
        self.turns = 0
        self.reads = 0
        self.seats: dict[int, Seat] = {}
        self.starting: set[Seat] = set()
        """Those for whose first wait time stands still."""
        self._guard = allocate_lock()
        self._ready: deque[Seat] = deque()
        self._deadlines: list[tuple[int, int, Seat]] = []
        self._next_rank = 0
        self._instant_waits = 0

    def driver_seat(self) -> Seat:
        """The seat of a thread that has the baton from the start and may keep it as long as it likes."""
        self.holder = seat = self.seats[LAST] = Seat(self, LAST, None)
        return seat

    def seat(self, state: WaitingThread | None) -> Seat:
        """A seat for a new thread, which is ready to run."""
        with self._guard:
            self._next_rank += 1
            seat = self.seats[self._next_rank] = Seat(self, self._next_rank, state)
            self._ready.append(seat)
            if self.holder is None:
                self._grant_next()
        return seat

    def leave(self, seat: Seat) -> None:
        """The thread ends."""
        with self._guard:
            self.seats.pop(seat.rank, None)
            self.starting.discard(seat)
            if self.holder is not seat:
                with suppress(ValueError):
                    self._ready.remove(seat)
            if self.holder is seat or self.holder is None:
                self._grant_next()

    def wait(self, seat: Seat, wakeup: Awaited | None, deadline: int | None) -> bool:
        """Hand the baton on; True when the wakeup is set, False when due or roused."""
        with self._guard:
            self.turns += 1
            self._instant_waits += 1
            if self.starting:
                self.starting.discard(seat)
            if self._instant_waits > INSTANT_WAITS:
                self.now += POLL_NS
            if wakeup is not None and wakeup.flag:
                # What is set already costs no turn; but who only ever does that would let nobody else run.
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
                    # A signal that another thread received ends no acquire here, though its handler runs in this one.
                    while not seat.lock.acquire(True, SIGNAL_CHECK_S):
                        pass
            except BaseException:  # a handler of a real signal raised in the real main thread
                self._reclaim(seat)
                raise
        if seat.waiting:
            self._withdraw(seat, wakeup)
        return seat.woken or (wakeup is not None and wakeup.flag)

    def _is_next(self, seat: Seat, deadline: int) -> bool:
        """Whether nothing happens before a wait of the holder is over, or at the same time."""
        deadlines = self._deadlines
        return (
            not self._ready
            and self.now < deadline
            and (not deadlines or deadline < deadlines[0][0])
            and not (seat.detached or self.starting or (seat.state is not None and seat.state.called))
        )

    def wait_outside(self, wakeup: Awaited, deadline: int | None) -> bool:
        """The wait of a thread that never has the baton: it goes on beside the one that has."""
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
        """Set a wakeup: all that wait for it are ready, in the order of their waits."""
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

        If so, what `note` says of it before the next one goes on; else None.
        """
        with self._guard:
            if self.holder is not seat or self.turns != turns:
                return None
            seat.detached = True
            said = note(seat)
            self._grant_next()
            return said

    def stop_waiting_for_starts(self) -> None:
        """Let time go on although not all threads that hold it have come to their first wait."""
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
        """End a wait that nothing has ended."""
        seat.waiting = False
        if wakeup is not None:
            wakeup.waiters.remove(seat)

    def _next(self) -> Seat | None:
        """The thread whose turn it is now; time moves on when none is ready."""
        ready, deadlines = self._ready, self._deadlines
        while deadlines and (not ready or deadlines[0][0] <= self.now):
            deadline, rank, seat = deadlines[0]
            if seat.waiting and seat.due == deadline:
                # The driver comes after all others that are ready at this instant.
                if rank == LAST and ready and deadline == self.now:
                    break
                if deadline > self.now:
                    # How long a start takes in wall time must not decide what happens before it.
                    if self.starting:
                        break
                    self.now = deadline
                    self.reads = self._instant_waits = 0
                self._make_ready(seat)
            # Woken before it was due, or served now: either way this entry is done with.
            heappop(deadlines)
            if seat.in_heap == deadline:
                seat.in_heap = None
        return ready.popleft() if ready else None

    def _grant_next(self) -> None:
        self.holder = seat = self._next()
        if seat is not None:
            seat.lock.release()

    def _hand_on(self, seat: Seat) -> bool:
        """Let the next one run; whether `seat` has to wait for its turn."""
        if len(self._deadlines) > STALE_DEADLINES + 4 * len(self.seats):
            self._drop_stale_deadlines()
        if seat.detached:
            # It was taken for hanging, and somebody else may have the baton by now.
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
        # A turn that was granted meanwhile would let the next wait return at once.
        seat.lock.acquire(False)
