"""A user process in the run that this process coordinates: it takes turns like a thread of this process.

In its turn it runs until all its threads wait. Its output is read meanwhile, and to the end before the next turn.
"""

from __future__ import annotations

import os
import select
import signal
import socket
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

from ..notices import notify
from ..stepping.own_thread import start_own_thread
from ..stepping.stepped_time import BLOCKS
from ..watch.gil_holder import GilHolder
from ..watch.processor_time import state_and_seconds
from ..watch.thread_work import CHECKS_PER_STALL, COMPUTING
from .channel import SIGNAL, Channel, Operation, Welcome

if TYPE_CHECKING:
    from ..stepping.scheduler import ScheduledTask
    from ..stepping.stepped_time import SteppedTime

_MAX_READ_BYTES = 1 << 16
STOPPED = "T"
"""State of a stopped process, see proc(5)."""


Deliver = Callable[[Operation], None]


class Peer(Protocol):
    """A process as the middleware sees it."""

    def handle(self, operation: Operation) -> None:
        """Carry out an operation that the process has sent."""
        ...

    def leave(self) -> None:
        """Remove the process, which has ended."""
        ...


class Relay(Protocol):
    """The middleware between the processes."""

    def add(self, deliver: Deliver) -> Peer:
        """Add a process; `deliver(operation)` is called with each operation for it."""
        ...


@dataclass
class Reader:
    """Reads what a process writes to one of its pipes."""

    take: Callable[[bytes], None]
    end: Callable[[], None]
    at_once: bool
    held: list[bytes] = field(default_factory=list[bytes])
    """The data to be passed on at the end of the turn."""


class MemberProcess:
    """One process. Its methods may be called by any thread that has its turn."""

    def __init__(self, clock: SteppedTime, name: str, number: int, welcome: Welcome, relay: Relay) -> None:
        self.clock = clock
        self.name = name
        self.number = number
        """The number that identifies the process in the run."""
        self.notices: list[str] = []
        self.stderr = None
        self.pid = 0
        own, self.member_end = socket.socketpair()
        self._channel = Channel(own)
        self._welcome = welcome
        self._inbox: list[Operation] = []
        self._wakeup = clock.wakeup()
        self._readers: dict[int, Reader] = {}
        """The readers of the open pipes, by descriptor."""
        self._pipes: list[Reader] = []
        self._poll = select.poll()
        # Checked first, so that what the process wrote before its answer is read together with the answer.
        self._poll.register(own, select.POLLIN)
        self._peer = relay.add(self.deliver)
        self._over = False
        self.exit_code: int | None = None
        """The exit code; set by one of the readers."""

    def start(self) -> None:
        """Give the process its first turn, once a reader has set `pid`; the clock stops until its first wait."""
        self.member_end.close()
        self._task = start_own_thread(self.clock, self._run)
        self._task.hold_clock()

    def read(
        self, descriptor: int, take: Callable[[bytes], None], end: Callable[[], None], *, at_once: bool = False
    ) -> None:
        """Pass on what the process writes to a pipe, and the pipe's end; takes ownership of the descriptor.

        Data is passed on at the end of each turn, in the order in which the pipes were registered: how the writing and
        the reading overlap must not decide the order. With `at_once` it is passed on as it arrives.
        """
        reader = self._readers[descriptor] = Reader(take, end, at_once)
        self._pipes.append(reader)
        self._poll.register(descriptor, select.POLLIN)

    def deliver(self, operation: Operation) -> None:
        """Send an operation to the process in its next turn."""
        self._inbox.append(operation)
        self._wakeup.set()

    def send_signal(self, number: int) -> None:
        """Deliver a signal. Raises `ProcessLookupError` if the process has ended."""
        if self._over:
            raise ProcessLookupError
        if self._task.detached or number in (signal.SIGSTOP, signal.SIGCONT):
            os.kill(self.pid, number)
        else:
            self.deliver((SIGNAL, number))

    def close(self) -> None:
        """End the process now, at the end of the run."""
        if not self._over and self.pid:
            with suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)
        self._wakeup.set()

    def _run(self, task: ScheduledTask) -> None:
        scheduler, wakeup = task.scheduler, self._wakeup
        try:
            while not self.pid and self._readers:
                self._read_ready(None)
            self._channel.send(tuple(self._welcome))
            while (answer := self._turn(task)) is not None:
                self._pass_on()
                now, due, operations, stalls = answer
                self.clock.advance_to(now)
                self.clock.add_stalls(stalls)
                for each in operations:
                    self._peer.handle(each)
                scheduler.wait(task, None if due == now else wakeup, due)
        except OSError:  # the process has ended
            pass
        finally:
            self._over = True
            self._peer.leave()
            self._finish(task)

    def _turn(self, task: ScheduledTask) -> Any:
        """Let the process run until all its threads wait; return its answer, or None if it has ended."""
        operations, self._inbox = self._inbox, []
        self._wakeup.clear()
        scheduler = task.scheduler
        self._channel.send((scheduler.now, scheduler.horizon(), operations))
        watch = _HangDetector(self.pid, self.clock.stall_s)
        interval_ms = round(1e3 * self.clock.stall_s / CHECKS_PER_STALL)
        answer: Any = None
        while True:
            answered = False
            ready = self._poll.poll(interval_ms)
            for descriptor, _ in ready:
                if descriptor == self._channel.fileno():
                    answer, answered = self._channel.receive(), True
                else:
                    self._read(descriptor)
            if answered:
                while len(ready) > 1 and self._read_ready(0):
                    pass
                break
            if not ready and not task.detached and (line := watch.blocked_in()):
                self._go_on_without(task, line)
        if task.detached:
            scheduler.wait(task, None, scheduler.now)  # others run, so what it has published must wait for its turn
        return answer

    def _go_on_without(self, task: ScheduledTask, line: str) -> None:
        """Let others run beside a process that cannot answer."""
        scheduler = task.scheduler
        scheduler.starting.discard(task)
        scheduler.detach(task, scheduler.turns, lambda _: self.clock.add_stalls([f"{self.name}: {line}"]))
        notify(self, f"{line} {BLOCKS}")

    def _read_ready(self, timeout_ms: int | None) -> bool:
        """Wait for what the process writes to its pipes; return whether there was anything."""
        ready = [descriptor for descriptor, _ in self._poll.poll(timeout_ms) if descriptor in self._readers]
        for descriptor in ready:
            self._read(descriptor)
        return bool(ready)

    def _read(self, descriptor: int) -> None:
        reader = self._readers[descriptor]
        try:
            data = os.read(descriptor, _MAX_READ_BYTES)
        except OSError:  # a terminal whose other end is closed
            data = b""
        if not data:
            self._close(descriptor)
        elif reader.at_once:
            reader.take(data)
        else:
            reader.held.append(data)

    def _close(self, descriptor: int) -> None:
        self._poll.unregister(descriptor)
        del self._readers[descriptor]
        os.close(descriptor)

    def _pass_on(self) -> None:
        """Pass on what the process has written."""
        for each in self._pipes:
            if each.held:
                each.take(b"".join(each.held))
                each.held.clear()

    def _finish(self, task: ScheduledTask) -> None:
        """Read the rest until the exit code arrives; what the child processes write later is lost."""
        self._poll.unregister(self._channel)
        self._channel.close()
        while self._readers and (self.exit_code is None or self._read_ready(0)):
            if self.exit_code is None:
                self._read_ready(None)
        for descriptor in list(self._readers):
            self._close(descriptor)
        self._pass_on()
        # Its last output is handled before anybody is notified that it has ended.
        task.scheduler.wait(task, None, task.scheduler.now)
        for each in self._pipes:
            each.end()


class _HangDetector:
    """Detects that a process cannot answer: it is stopped, or its C code holds the GIL for a long time.

    A thread that blocks or computes otherwise is reported by the process's own watch.
    """

    def __init__(self, pid: int, stall_s: float) -> None:
        self._pid = pid
        self._stall_s = stall_s
        self._holder: GilHolder | None = None
        self._seconds: float | None = None
        self._computed = 0.0
        self._blocked = 0

    def blocked_in(self) -> str:
        """Check again, at even intervals; return the line in which the process hangs, empty if it does not."""
        reported = state_and_seconds(str(self._pid))
        if reported is None:
            return ""
        state, seconds = reported
        used = 0.0 if self._seconds is None else seconds - self._seconds
        self._seconds = seconds
        self._holder = self._holder or GilHolder(self._pid)
        line = f"process {self._pid}, which is stopped," if state == STOPPED else self._holder.held_in()
        self._computed = self._computed + used if line else 0.0
        self._blocked = self._blocked + 1 if line and not used else 0
        hangs = self._blocked >= CHECKS_PER_STALL or self._computed >= COMPUTING * self._stall_s
        return line if hangs else ""
