"""The gate for all commands: closed while the console starts, and if the console is read-only, lost or closed.

Standard library only. A stop does not pass through it: nothing may refuse a stop, see `robot/robot_drive.py`.
"""

from __future__ import annotations

import inspect
import threading
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

T = TypeVar("T")
STARTING = "the console is still connecting to the ROS system"
CLOSED = "the console has closed"
READ_ONLY = "this console is read-only (--read-only)"


@dataclass(frozen=True)
class _PendingRequest:
    """A request: how to turn a refusal into a result, and the coroutine that is to produce the result."""

    refused: Callable[[str], Any]
    task: Coroutine[Any, Any, None]


class Gate:
    """Passes commands and queries on to the system, or refuses them with the reason. Thread-safe."""

    def __init__(self, why: str = STARTING) -> None:
        """`why` is the reason for refusals before `open`; empty if there is nothing to wait for."""
        self.unreached = why
        """Why the system cannot be asked anything; empty while it can be reached."""
        self.read_only = ""
        """Why this console may not change anything; empty if it may."""
        self._start: Callable[[Coroutine[Any, Any, None]], object] | None = None
        self._pending: dict[Future[Any], _PendingRequest] = {}
        self._queries: list[Callable[[], object]] = []
        self._lock = threading.Lock()

    @property
    def refusal(self) -> str:
        """Why a command that changes something is refused; empty if it may pass."""
        return self.read_only or self.unreached

    def open(self, start: Callable[[Coroutine[Any, Any, None]], object]) -> None:
        """Let requests through, and make the waiting queries. `start` runs a coroutine, from any thread."""
        with self._lock:
            self._start, self.unreached = start, ""
            queries, self._queries = self._queries, []
        for query in queries:
            query()

    def close(self, why: str) -> None:
        """Refuse all pending and later requests with this reason."""
        with self._lock:
            self.unreached = why
            self._queries = []
            waiting = list(self._pending)
        for outcome in waiting:
            self._refuse(outcome, why)

    def when_open(self, query: Callable[[], object]) -> None:
        """Make a query now, or once the system is reached; never after it is lost or the console has closed."""
        with self._lock:
            if self.unreached == STARTING:
                self._queries.append(query)
            if self.unreached:
                return
        query()

    def run_when_open(self, work: Callable[[], object]) -> None:
        """Run a function in the console's executor, at the time at which `when_open` makes a query."""

        async def run() -> None:
            work()

        self.when_open(lambda: self.run(run, lambda why: None, changes=False))

    def run(
        self, work: Callable[[], Coroutine[Any, Any, T]], refused: Callable[[str], T], *, changes: bool = True
    ) -> Future[T]:
        """Run a coroutine in the console's executor.

        The future is always completed: `refused` turns the reason of a refusal into a result, or raises it. A request
        that only reads has `changes` false, and passes in a read-only console too.
        """
        outcome: Future[T] = Future()

        async def guarded() -> None:
            try:
                result = await work()
            except Exception as error:  # is passed on through the future
                if self._claim(outcome):
                    outcome.set_exception(error)
            else:
                if self._claim(outcome):
                    outcome.set_result(result)

        task = guarded()
        with self._lock:
            why = self.refusal if changes else self.unreached
            self._pending[outcome] = _PendingRequest(refused, task)
        if why or self._start is None:
            self._refuse(outcome, why)
        else:
            self._start(task)
        return outcome

    def _claim(self, outcome: Future[Any]) -> _PendingRequest | None:
        """Remove a pending request; the caller that gets it has to complete it."""
        with self._lock:
            return self._pending.pop(outcome, None)

    def _refuse(self, outcome: Future[Any], why: str) -> None:
        pending = self._claim(outcome)
        if pending is None:
            return
        if inspect.getcoroutinestate(pending.task) == inspect.CORO_CREATED:
            pending.task.close()  # otherwise the interpreter warns that it was never awaited
        try:
            outcome.set_result(pending.refused(why))
        except Exception as error:  # `refused` may raise the reason
            outcome.set_exception(error)


def refuse(why: str) -> Any:
    """Raise a refusal, for futures that have no other way to express it."""
    raise ValueError(why)


def done(value: T) -> Future[T]:
    """A future that is already done, with its result."""
    future: Future[T] = Future()
    future.set_result(value)
    return future
