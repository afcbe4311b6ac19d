"""What a middleware connects: nodes, publishers, subscriptions, servers and clients, as the graph knows them."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

from bot_console.runtime.rmw.qos import Profile

Notify = Callable[[], None]
"""Called, from any thread, when an endpoint has something new."""

Event = Literal["matched", "incompatible", "alive", "gone", "asserted", "lost", "message"]
"""What an endpoint's handlers are told. With "matched" comes 1 or -1, with "incompatible" the name of the policy, with
"alive", "gone" and "asserted" the publisher (`Publisher` in `bus.py`) that came, went, or gave a sign of life, with
"lost" how many messages did not arrive.
"message" is no event of a middleware: it tells those who watch that one was published or has come."""

OnEvent = Callable[[Event, Any], None]

Message = Any
"""A message, request or response. The generated classes have no base class; `_copy_()` copies and checks one."""

_gids = itertools.count(1)


def new_gid() -> bytes:
    """A number that no other endpoint of this process has, in 16 bytes."""
    return next(_gids).to_bytes(16, "little")


def depth(qos: Profile) -> int | None:
    """The length of a queue; None where all is kept."""
    return None if qos.history.name == "KEEP_ALL" else max(1, qos.depth or 10)


def queue_for(qos: Profile) -> deque[Any]:
    """An empty queue of the length that a profile asks for."""
    return deque(maxlen=depth(qos))


def no_event(kind: Event, what: Any) -> None:
    """Nobody listens to the events of an endpoint."""


@dataclass(frozen=True)
class NodeId:
    """A node of the graph; two nodes may have the same name, so identity counts."""

    name: str
    namespace: str
    enclave: str = "/"
    number: int = 0


@dataclass(eq=False)
class Endpoint:
    """A publisher or subscription as the graph knows it. `topic` is fully qualified, `gid` has 16 bytes.

    One of another process may have no class here; what is known of its type is name and hash (`RIHS01_...`).
    """

    node: NodeId
    topic: str
    type_name: str
    qos: Profile
    gid: bytes
    message_class: Any = None
    type_hash: str | None = None


@dataclass(eq=False)
class SubscriptionEndpoint:
    """Receives messages: `queue` holds what has come, as (message, source ns, sequence number, expiry ns)."""

    endpoint: Endpoint
    raw: bool
    queue: deque[Any]
    notify: Notify
    on_event: OnEvent = no_event
    matched: int = 0


@dataclass(eq=False)
class ServiceEndpoint:
    """Answers requests: `queue` holds (client, sequence number, request)."""

    node: NodeId
    name: str
    type_name: str
    notify: Notify
    service_class: Any = None
    queue: deque[Any] = field(default_factory=deque[Any])


@dataclass(eq=False)
class ClientEndpoint:
    """Asks requests: `queue` holds (sequence number, response)."""

    node: NodeId
    name: str
    type_name: str
    notify: Notify
    service_class: Any = None
    queue: deque[Any] = field(default_factory=deque[Any])
    gid: bytes = field(default_factory=new_gid)
