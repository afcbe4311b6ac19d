"""A process in a stepped run that another process coordinates: its threads take turns, in the coordinator's time.

Its main thread and the threads that it starts belong to the program, which runs as in any process. One additional
thread, the *steward*, drives the process's own scheduler: it talks to the coordinator while all others wait.
"""

from __future__ import annotations

import _thread
import os
import queue
import random
import signal
import socket
import sys
import threading
import time
import traceback
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from ..current import MAIN
from ..node.thread_state import ThreadState, local
from ..real_time import RealTime
from ..stepping import event_loop
from ..stepping.calls import uninstall_stepped_calls
from ..stepping.one_cpu import import_numpy
from ..stepping.stepped_time import SteppedTime
from ..virtual import child_threads, waits
from ..watch.gil_watch import move_to_high_descriptor
from . import alarms
from .channel import SIGNAL, Channel, Operation, Welcome

if TYPE_CHECKING:
    from ..clock_source import Wakeup

COORDINATOR_GONE = 1
"""Exit code of a process that gets no more turns because its coordinator has ended."""


class Member:
    """The part of this process in a stepped run."""

    def __init__(self, connection: socket.socket) -> None:
        # A high number, as a program may close all descriptors that it knows of.
        self._channel = Channel(socket.socket(fileno=move_to_high_descriptor(connection.detach())))
        self._outbox: list[Operation] = []
        self._published: Wakeup | None = None
        self._undo: list[tuple[Any, str, Any]] = []
        self._stalls = 0
        self._paused: Wakeup | None = None

    def send(self, operation: Operation) -> None:
        """Pass an operation to the coordinator at the end of this process's turn."""
        self._outbox.append(operation)
        if self._published is not None:
            self._published.set()

    def join(self, take: Callable[[Operation], None], news: Callable[[], list[Operation]]) -> None:
        """Join the run with the calling thread as the program's main thread; returns when that thread has its turn.

        `take(operation)` is called with each operation that comes from the coordinator; `news()` returns further
        operations to send to it at the end of each turn.
        """
        self._take, self._news = take, news
        welcome = self._channel.receive()
        if welcome is None:
            os._exit(COORDINATOR_GONE)
        given = Welcome(*welcome)
        if given.processors:
            os.sched_setaffinity(0, given.processors)
        import_numpy()
        random.seed(given.seed)
        sys.modules["numpy.random"].seed(given.seed % (1 << 32))
        begun = _thread.allocate_lock()
        begun.acquire()
        _thread.start_new_thread(self._steward, (given, begun.release))
        begun.acquire()
        self._main.ident = threading.get_ident()
        local.state, local.waits_on, local.task = self._main, self._clock, self._main.task
        if self._main.task is not None:
            self._main.task.take()

    def _steward(self, given: Welcome, begun: Callable[[], None]) -> None:
        self._clock = clock = SteppedTime(given.system_offset, stall_s=given.stall_s)
        MAIN.clock = local.waits_on = clock
        self._published = clock.wakeup()
        self._main = ThreadState(MAIN, clock, threading.main_thread())
        if self._main.task is not None:
            self._main.task.hold_clock()  # importing takes no virtual time
        self._wrap_calls()
        begun()
        try:
            while True:
                self._run_turn(self._published)
        except OSError:  # the coordinator has ended
            os._exit(COORDINATOR_GONE)
        except BaseException:  # without this thread all others would wait for their turns for ever
            traceback.print_exc(file=sys.__stderr__)
            os._exit(COORDINATOR_GONE)

    def _run_turn(self, published: Wakeup) -> None:
        """Wait for a grant, run all threads until they wait, and answer."""
        grant = self._channel.receive()
        if grant is None:
            os._exit(COORDINATOR_GONE)  # nothing else could end threads that wait for a turn
        now, horizon, operations = grant
        clock = self._clock
        clock.advance_to(now)
        for each in operations:
            if each[0] == SIGNAL:
                self.signal(each[1])
            else:
                self._take(each)
        published.clear()
        # Events before the horizon concern this process alone, until it publishes something.
        if horizon is not None and horizon > now and not self._outbox:
            published.wait(horizon - 1)
        clock.run_until(clock.steady_ns())
        outbox, self._outbox = [*self._outbox, *self._news()], []
        stalls, self._stalls = clock.stalls[self._stalls :], len(clock.stalls)
        self._channel.send((clock.steady_ns(), clock.earliest_deadline(), outbox, stalls))

    def signal(self, number: int) -> None:
        """Deliver a signal; a handler runs in the main thread, which is woken from any wait."""
        handler = signal.getsignal(number)
        if not callable(handler):
            os.kill(os.getpid(), number)
        elif self._main.takes_turns:
            self._main.post(partial(self._handle, handler, number))
        else:  # the main thread blocks in a call that the run does not see
            signal.pthread_kill(self._main.ident, number)
            if self._main.task is not None:
                self._main.task.attach()  # so that no time passes before it has handled the signal

    def _handle(self, handler: Callable[[int, Any], Any], number: int) -> None:
        if self._paused is not None:
            self._paused.set()
        handler(number, sys._getframe())  # pyright: ignore[reportPrivateUsage] -- documented in `sys`

    def _pause(self) -> None:
        """`signal.pause`."""
        self._paused = self._clock.wakeup()
        self._paused.wait()

    def _wrap_calls(self) -> None:
        wraps: list[tuple[Any, str, Any]] = [
            (threading.Thread, "start", child_threads.start),
            (threading.Thread, "join", child_threads.join),
            (threading.Thread, "is_alive", child_threads.is_alive),
            (threading.Condition, "wait", waits.condition_wait),
            (queue, "SimpleQueue", waits.SimpleQueue),
            (time, "sleep", waits.sleep),
            (signal, "pause", self._pause),
            *alarms.wraps(alarms.Alarm(self._clock, self.signal)),
            *event_loop.wraps(),
        ]
        for owner, name, replacement in wraps:
            self._undo.append((owner, name, getattr(owner, name)))
            setattr(owner, name, replacement)
        os.register_at_fork(after_in_child=self._leave)

    def _leave(self) -> None:
        """Leave the run in a fork of this process, which is not a member of it."""
        while self._undo:
            setattr(*self._undo.pop())
        uninstall_stepped_calls()
        self._channel.close()
        MAIN.clock = RealTime()
        MAIN.pid = os.getpid()
        local.state = local.task = local.waits_on = None
