"""The fork server's loop: starts children and reports how they ended. It never starts a second thread."""

from __future__ import annotations

import gc
import os
import select
import signal
import socket
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from . import orphans, wire
from .job import Job
from .report import report_exit, report_pid, report_problem

ESCALATION_S = 5.0
"""Time (s) between SIGINT and SIGTERM, and between SIGTERM and SIGKILL, to the children of a parent that has ended."""
ORPHANS_S = 1.0
"""Time (s) between SIGTERM and SIGKILL to the processes that children have left behind."""
HELD_BACK = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGCHLD)
"""Signals blocked in a child until it is ready for them."""


@dataclass
class NewChild:
    """The data that a new child receives."""

    job: Job
    stdio: tuple[int, int, int]
    data: int
    """The descriptor of its data pipe."""


@dataclass
class Server:
    """Serves one parent until the parent has ended."""

    parent: socket.socket
    prepare: Callable[[Job], object]
    """Called with each job before the fork, to import the modules its program needs."""
    _children: dict[int, int] = field(default_factory=dict[int, int])
    """The report descriptor of each child, by pid."""
    _sessions: set[int] = field(default_factory=set[int])
    """The session ids of all children started so far."""
    _ending: bool = False

    def serve(self) -> NewChild | None:
        """Start children until the parent and all of them have ended; return None, but in each child its `NewChild`."""
        wake, woken = os.pipe()
        os.set_blocking(wake, False)
        os.set_blocking(woken, False)
        # A signal makes `select` return: a child may end, or the parent may ask the server to end, at any time.
        signal.set_wakeup_fd(woken, warn_on_full_buffer=False)
        for each in HELD_BACK:
            signal.signal(each, self._signalled)
        orphans.adopt()
        while not self._ending:
            birth = self._next() if self._poll(wake) else None
            if birth is not None:
                signal.set_wakeup_fd(-1)
                os.close(wake)
                os.close(woken)
                self.parent.close()
                return birth
        self._end_children(wake)
        self._end_orphans(wake)
        return None

    def _poll(self, wake: int, timeout: float | None = None) -> bool:
        """Wait for a request or a signal, at most `timeout` seconds; return whether there is a request."""
        ready, _, _ = select.select([wake] if self._ending else [self.parent, wake], [], [], timeout)
        if wake in ready:
            os.read(wake, 4096)
        self._reap()
        return self.parent in ready

    def _signalled(self, number: int, _frame: object) -> None:
        if number != signal.SIGCHLD:
            self._ending = True

    def _next(self) -> NewChild | None:
        """Handle a request; in the child, return its `NewChild`."""
        request = wire.receive(self.parent)
        if request is None:
            self._ending = True
            return None
        data, descriptors = request
        *given, report = descriptors
        job = Job.from_bytes(data)
        self.prepare(job)
        gc.freeze()  # pages of objects that the collector never touches are not copied into each child
        # Until the child has its own handlers, a signal to it would run those of the server.
        signal.pthread_sigmask(signal.SIG_BLOCK, HELD_BACK)
        try:
            pid = os.fork()
        except OSError as error:
            report_problem(report, str(error.strerror))
            self._release((*given, report))
            return None
        if pid == 0:
            os.close(report)
            for each in self._children.values():
                # Close the siblings' reports: a child that kept them open would hide the end of a sibling.
                os.close(each)
            if len(given) > 4:
                job = job._replace(arguments=[*job.arguments, given[4]])
            return NewChild(job, (given[0], given[1], given[2]), given[3])
        signal.pthread_sigmask(signal.SIG_UNBLOCK, HELD_BACK)
        self._release(given)
        self._children[pid] = report
        self._sessions.add(pid)
        report_pid(report, pid)
        return None

    @staticmethod
    def _release(descriptors: Sequence[int]) -> None:
        for each in descriptors:
            os.close(each)

    def _reap(self) -> None:
        while True:
            try:
                pid, status = os.waitpid(-1, os.WNOHANG)
            except ChildProcessError:
                return
            if pid == 0:
                return
            report = self._children.pop(pid, None)
            if report is not None:  # otherwise it is an orphan left by a child
                report_exit(report, os.waitstatus_to_exitcode(status))
                os.close(report)

    def _end_children(self, wake: int) -> None:
        """End the children of a parent that has ended, since nobody else could stop them."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            for pid in self._children:
                os.kill(pid, number)  # not reaped yet, so the pid is still the child's
            deadline = time.monotonic() + ESCALATION_S
            while self._children and (left := deadline - time.monotonic()) > 0:
                self._poll(wake, left)

    def _end_orphans(self, wake: int) -> None:
        for number in (signal.SIGTERM, signal.SIGKILL):
            deadline = time.monotonic() + ORPHANS_S
            while orphans.request_exit(self._sessions, number) and (left := deadline - time.monotonic()) > 0:
                self._poll(wake, min(left, ORPHANS_S / 10))
