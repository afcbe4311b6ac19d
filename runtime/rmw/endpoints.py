"""The entities that a middleware connects: nodes, publishers, subscriptions, servers and clients."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

from bot_console.runtime.rmw.names import full_name
from bot_console.runtime.rmw.qos import Profile

Notify = Callable[[], None]
"""Called, from any thread, when an endpoint has something new."""

Owner = tuple[str, str]
"""Name and namespace of a node. Two nodes may have the same, and are then asked about as one."""

GraphChanged = Callable[[Owner], None]
"""Called, from any thread, with whose place in the graph has changed."""

Event = Literal["matched", "incompatible", "alive", "gone", "asserted", "lost", "message"]
"""What an endpoint's handlers are told. With "matched" comes 1 or -1, with "incompatible" the name of the policy, with
"alive", "gone" and "asserted" the publisher (`Publisher` in `bus.py`) that came, went, or gave a sign of life, with
"lost" how many messages did not arrive.
"message" is no event of a middleware: it tells those who watch that one was published or has come."""

OnEvent = Callable[[Event, Any], None]

Message = Any
"""A message, request or response. The generated classes have no base class; `_copy_()` copies and checks one."""

Hear = Callable[["Endpoint", bytes, int, int, Message], None]
"""Called, in the thread that publishes or receives, with each message that a process carries: an endpoint that tells
topic, class and QoS, the publisher's gid, the message's number there, when it was sent (ns), and the message, or its
bytes where it was serialized. It must not be changed; what another process sent comes once for each subscription."""


class Tap:
    """Where the endpoints of a bus find who overhears them."""

    __slots__ = ("hear",)

    def __init__(self) -> None:
        self.hear: Hear | None = None
        """None while nobody listens."""


class Held:
    """A message in a queue that is not its taker's own yet."""

    __slots__ = ()

    def take(self) -> Message | None:
        """A message that nobody else holds; None where it turns out to be none, which has been told then."""
        raise NotImplementedError


class Shared(Held):
    """A message in the queues of several: each that takes it gets a copy of its own, the last one the message itself.

    Copied when it is taken, a message costs its publisher and the queues the same for any number of subscriptions,
    and what a full queue drops is never copied.
    """

    __slots__ = ("_left", "_message")

    def __init__(self, message: Message, takers: int) -> None:
        self._message = message
        self._left = takers

    def take(self) -> Message:
        """A message that nobody else holds."""
        if self._left == 1:
            return self._message
        copy = self._message._copy_()
        # Two threads at once may count as one: then a copy too many is made, never one too few.
        self._left -= 1
        return copy


def own(message: Message) -> Message | None:
    """A message of a queue as its taker's own; None where it cannot be read, which has been told then."""
    return message.take() if isinstance(message, Held) else message


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


class NodeId(NamedTuple):
    """A node of the graph; two nodes may have the same name, so identity counts."""

    name: str
    namespace: str
    enclave: str = "/"
    number: int = 0

    @property
    def full_name(self) -> str:
        """The name with its namespace before it."""
        return full_name(self.namespace, self.name)

    @property
    def owner(self) -> Owner:
        """Name and namespace."""
        return self.name, self.namespace


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
    """Receives messages: `queue` holds what has come, as (message, source ns, sequence number, expiry ns).

    The message may be `Held`, and `own` makes it the taker's.
    """

    endpoint: Endpoint
    raw: bool
    queue: deque[Any]
    notify: Notify
    on_event: OnEvent = no_event
    matched: int = 0


@dataclass(eq=False)
class ServiceEndpoint:
    """Answers requests: `queue` holds (client, sequence number, request); `type_hash` where it is another process's."""

    node: NodeId
    name: str
    type_name: str
    notify: Notify
    service_class: Any = None
    queue: deque[Any] = field(default_factory=deque[Any])
    type_hash: str | None = None


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
