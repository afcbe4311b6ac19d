"""Makes the console's service calls: with a timeout, and without blocking."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Coroutine
from typing import Any

from bot_console.tui.console.command_gate import Gate
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.task import Future as RosFuture

ANSWER_TIMEOUT_S = 5.0
"""Seconds to wait for a response, beyond what the link to the robot takes: a hung node never sends it."""

LINK_DELAYS = 3
"""How many round trips of the link a response may take. A request may have to wait behind larger messages, and the
delay of a link that fills up is longer than the last one measured.
"""

LinkDelay = Callable[[], float]
"""Returns the latest round-trip time of the link to the robot, in seconds; 0 if it is unknown, or there is no link."""


def no_delay() -> float:
    """Return the delay of nodes on this machine."""
    return 0.0


MIN_POLLS = 5
"""The minimum number of polls before a timeout.

If this process itself got no processor time, it could not receive responses, so the delay must not count as the
server's. A late poll counts once, however late it is.
"""

MAX_POLL_S = 1.0
"""The longest time between two polls, so that the disappearance of a server is noticed soon."""

GONE_POLLS = 2
"""Consecutive polls without a server after which no response is expected. After one, the server may be restarting, or
respond while it shuts down.
"""

READY_TIMEOUT_S = 2.0
"""Seconds that a new client may take to discover a server that is in the graph, as on a slow network."""

READY_POLL_S = 0.02
"""Seconds between two checks whether the client is ready."""


class NoAnswer(Exception):
    """A service did not respond in time; the message says which one."""


class Calls:
    """Calls services from coroutines in the console's executor."""

    def __init__(self, node: Node, gate: Gate, link_delay: LinkDelay = no_delay) -> None:
        self._node = node
        self._gate = gate
        self._link_delay = link_delay
        self._clients: dict[tuple[str, str], Any] = {}

    def run(self, work: Callable[[], Coroutine[Any, Any, object]]) -> None:
        """Start a coroutine that only reads, unless the console has closed; from any thread."""
        self._gate.run(work, lambda why: None, changes=False)

    async def ask(self, kind: Any, service: str, request: Any, timeout_s: float = ANSWER_TIMEOUT_S) -> Any:
        """Call a service; raises `NoAnswer` when there is no server or none responds in time.

        A slow link gets more time than `timeout_s`.
        """
        client = self._client(kind, service)
        if not (client.service_is_ready() or await self._wait_until_ready(client, service)):
            raise NoAnswer(f"no service {service} is offered; has its node ended?")
        answer: RosFuture[Any] = client.call_async(request)
        period, away = min(MAX_POLL_S, timeout_s / MIN_POLLS), 0
        polls, allowed_s = itertools.count(1), timeout_s

        def poll() -> None:
            nonlocal away, allowed_s
            allowed_s = max(allowed_s, timeout_s + round(LINK_DELAYS * self._link_delay()))
            away = 0 if _is_available(client) else away + 1
            if away >= GONE_POLLS:
                self._give_up(answer, client, f"{service} went away before it answered; has its node ended?")
            elif next(polls) * period >= allowed_s:
                hint = "its node may be busy or hung, or its link slow, and it may still carry out the request"
                self._give_up(answer, client, f"{service} did not answer within {allowed_s:g} s; {hint}")

        timer = self._node.create_timer(period, poll)
        try:
            return await answer
        finally:
            self._node.destroy_timer(timer)

    async def _wait_until_ready(self, client: Any, service: str) -> bool:
        """Wait until a new client has discovered its server; False at once if the server is not in the graph."""
        if not self._node.count_services(service):
            return False
        found: RosFuture[bool] = RosFuture()
        polls = itertools.count(1)

        def poll() -> None:
            try:
                ready = client.service_is_ready()
                over = ready or next(polls) * READY_POLL_S >= READY_TIMEOUT_S
            except InvalidHandle:  # the node has left in the meantime, see `forget`
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


def _is_available(client: Any) -> bool:
    """Whether the server of a client is in the graph."""
    try:
        return bool(client.service_is_ready())
    except InvalidHandle:  # the node has left, see `forget`
        return False
