"""Service calls of the console: from any thread, with a timeout, never blocking."""

from __future__ import annotations

import inspect
import itertools
import threading
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.task import Future as RosFuture

T = TypeVar("T")
ANSWER_TIMEOUT_S = 5.0
"""Seconds to wait for a response: a slow link delivers it late, a hung node never sends it."""

MIN_POLLS = 5
"""The least number of polls before a timeout.

If this process itself got no processor time, it could not receive responses, so the delay must not count as the
server's. A late poll counts once, however late it is.
"""

MAX_POLL_S = 1.0
"""The longest time between two polls, so that the disappearance of a server is noticed soon."""

GONE = 2
"""Consecutive polls without a server after which no response is expected. After one it may be restarting, or respond
while it shuts down.
"""

READY = 2.0
"""Seconds that a new client may take to discover a server that is in the graph, as on a slow network."""

READY_POLL_S = 0.02
"""Seconds between two checks whether it has."""


class NoAnswer(Exception):
    """A service did not respond in time; the message says which one."""


def _raise(why: str) -> Any:
    raise NoAnswer(why)


@dataclass(frozen=True)
class _Pending:
    """How to express a refusal as a result, and the coroutines that are to produce the result."""

    refused: Callable[[str], Any]
    coroutines: tuple[Coroutine[Any, Any, Any], ...]


class Calls:
    """Runs coroutines in the console's executor, and calls services from them."""

    def __init__(self, node: Node, executor: Executor) -> None:
        self._node = node
        self._executor = executor
        self._clients: dict[tuple[str, str], Any] = {}
        self._lock = threading.Lock()
        self._pending: dict[Future[Any], _Pending] = {}
        self._closed = ""

    def run(self, work: Coroutine[Any, Any, T], refused: Callable[[str], T] = _raise) -> Future[T]:
        """Start a coroutine in the executor, from any thread.

        The future is always completed: when the console closes, `refused` turns the reason into a result.
        """
        outcome: Future[T] = Future()

        async def guarded() -> None:
            try:
                result = await work
            except Exception as error:  # goes to the holder of the future
                if self._claim(outcome):
                    outcome.set_exception(error)
            else:
                if self._claim(outcome):
                    outcome.set_result(result)

        task = guarded()
        with self._lock:
            closed = self._closed
            self._pending[outcome] = _Pending(refused, (task, work))
        if closed:
            self._refuse(outcome, closed)
        else:
            self._executor.create_task(task)
        return outcome

    def _claim(self, outcome: Future[Any]) -> _Pending | None:
        """Remove a pending entry: the caller that gets it is the one to complete it."""
        with self._lock:
            return self._pending.pop(outcome, None)

    def _refuse(self, outcome: Future[Any], why: str) -> None:
        pending = self._claim(outcome)
        if pending is None:
            return
        for each in pending.coroutines:
            if inspect.getcoroutinestate(each) == inspect.CORO_CREATED:
                each.close()  # otherwise the interpreter warns that it was never awaited
        try:
            outcome.set_result(pending.refused(why))
        except NoAnswer as error:
            outcome.set_exception(error)

    def close(self, why: str) -> None:
        """Refuse all pending and all later requests with this reason."""
        with self._lock:
            self._closed = why
            waiting = list(self._pending)
        for outcome in waiting:
            self._refuse(outcome, why)

    async def ask(self, kind: Any, service: str, request: Any, timeout_s: float = ANSWER_TIMEOUT_S) -> Any:
        """Call a service; raises `NoAnswer` when there is no server or none responds in time."""
        client = self._client(kind, service)
        if not (client.service_is_ready() or await self._gets_ready(client, service)):
            raise NoAnswer(f"no service {service} is offered; has its node ended?")
        answer: RosFuture[Any] = client.call_async(request)
        period, away = min(MAX_POLL_S, timeout_s / MIN_POLLS), 0
        polls = itertools.count(1)

        def poll() -> None:
            nonlocal away
            away = 0 if _is_there(client) else away + 1
            if away >= GONE:
                self._give_up(answer, client, f"{service} went away before it answered; has its node ended?")
            elif next(polls) * period >= timeout_s:
                why = f"{service} did not answer within {timeout_s:g} s; its node may be busy or hung"
                self._give_up(answer, client, why)

        timer = self._node.create_timer(period, poll)
        try:
            return await answer
        finally:
            self._node.destroy_timer(timer)

    async def _gets_ready(self, client: Any, service: str) -> bool:
        """Wait for a server that is in the graph: a new client has to discover it first."""
        if not self._node.count_services(service):
            return False
        found: RosFuture[bool] = RosFuture()
        polls = itertools.count(1)

        def poll() -> None:
            try:
                ready = client.service_is_ready()
                over = ready or next(polls) * READY_POLL_S >= READY
            except InvalidHandle:  # its node has left in the meantime, see `forget`
                ready, over = False, True
            if over and not found.done():
                found.set_result(ready)

        timer = self._node.create_timer(READY_POLL_S, poll)
        try:
            return bool(await found)
        finally:
            self._node.destroy_timer(timer)

    @staticmethod
    def _give_up(answer: RosFuture[Any], client: Any, why: str) -> None:
        if not answer.done():
            client.remove_pending_request(answer)
            answer.set_exception(NoAnswer(why))

    def _client(self, kind: Any, service: str) -> Any:
        key = (service, kind.__name__)
        if key not in self._clients:
            self._clients[key] = self._node.create_client(kind, service)
        return self._clients[key]

    def forget(self, prefix: str) -> None:
        """Destroy the clients of all services with a prefix, for example those of a node that has left."""
        for key in [key for key in self._clients if key[0].startswith(prefix)]:
            self._node.destroy_client(self._clients.pop(key))


def _is_there(client: Any) -> bool:
    """Whether the server of a client is in the graph."""
    try:
        return bool(client.service_is_ready())
    except InvalidHandle:  # its node has left, see `forget`
        return False
