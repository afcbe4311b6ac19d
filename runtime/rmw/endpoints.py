"""The entities that a middleware connects: nodes, publishers, subscriptions, servers and clients."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable
from typing import Any, Literal, NamedTuple

from bot_console.runtime.rmw.names import full_name
from bot_console.runtime.rmw.qos import Profile

Notify = Callable[[], None]
"""Called, from any thread, when an endpoint has received something."""

Owner = tuple[str, str]
"""Name and namespace of a node. Two nodes with the same pair count as one in graph queries."""

GraphChanged = Callable[[Owner], None]
"""Called, from any thread, with the node whose graph entries have changed."""

Event = Literal["matched", "incompatible", "alive", "gone", "asserted", "lost", "message"]
"""Events passed to an endpoint's handlers. The argument is 1 or -1 for "matched", the name of the policy for
"incompatible", the publisher (`Publisher` in `bus.py`) that appeared, disappeared or asserted its liveliness for
"alive", "gone" and "asserted", and the number of lost messages for "lost". "message" is no middleware event: it informs
observers that a message was published or received.
"""

OnEvent = Callable[[Event, Any], None]

Payload = Any
"""A message, request or response: an instance of the class of its topic or service, or the bytes that the sender had
serialized. Only the code that created the endpoint knows the class; `_copy_()` copies and checks an instance.
"""

MessageObserver = Callable[["Endpoint", bytes, int, int, Payload], None]
"""Called, in the thread that publishes or receives, with each message that a process carries: an endpoint that gives
topic, class and QoS, the publisher's gid, its sequence number, the time of sending (ns), and the message, or its bytes
if it was serialized. The message must not be changed; one from another process is passed once per subscription.
"""


class Tap:
    """Holds the observer of all messages, which the endpoints of a bus share."""

    __slots__ = ("observer",)

    def __init__(self) -> None:
        self.observer: MessageObserver | None = None
        """None while there is no observer."""


class HeldMessage:
    """A queued message that must be taken with `take`, as others may still hold it."""

    __slots__ = ()

    def take(self) -> Payload | None:
        """Return a message that nobody else holds; None if it cannot be read, which has then been reported."""
        raise NotImplementedError

    def peek(self) -> Payload | None:
        """Return the message for reading only; None if it cannot be read, which has then been reported."""
        raise NotImplementedError


class SharedMessage(HeldMessage):
    """A message in several queues: each taker gets its own copy, the last one the message itself.

    Copying on `take` makes the cost for the publisher and the queues independent of the number of subscriptions, and a
    message dropped by a full queue is never copied.
    """

    __slots__ = ("_left", "_message")

    def __init__(self, message: Payload, takers: int) -> None:
        self._message = message
        self._left = takers

    def take(self) -> Payload:
        """Return a message that nobody else holds."""
        if self._left == 1:
            return self._message
        copy = self._message._copy_()
        # Two threads may decrement the same count at once: that makes one copy too many, never one too few.
        self._left -= 1
        return copy

    def peek(self) -> Payload:
        """Return the message for reading only."""
        return self._message


def take_queued(message: Payload) -> Payload | None:
    """Take a queued message; None if it cannot be read, which has then been reported."""
    return message.take() if isinstance(message, HeldMessage) else message


_gids = itertools.count(1)


def new_gid() -> bytes:
    """Return an id unique among the endpoints of this process, 16 bytes long."""
    return next(_gids).to_bytes(16, "little")


def depth(qos: Profile) -> int | None:
    """Return a queue's length; None for KEEP_ALL."""
    return None if qos.history.name == "KEEP_ALL" else max(1, qos.depth or 10)


def queue_for(qos: Profile) -> deque[Arrival]:
    """Return an empty queue of the length that a profile requires."""
    return deque(maxlen=depth(qos))


def no_event(kind: Event, what: Any) -> None:
    """Ignore an event; the default handler."""


class NodeId(NamedTuple):
    """A node of the graph; `number` distinguishes nodes of the same name."""

    name: str
    namespace: str
    enclave: str = "/"
    number: int = 0

    @property
    def full_name(self) -> str:
        """The fully qualified name."""
        return full_name(self.namespace, self.name)

    @property
    def owner(self) -> Owner:
        """Name and namespace."""
        return self.name, self.namespace


Arrival = tuple[Payload, int, int, int, "int | None"]
"""An entry of a subscription's queue: message or `HeldMessage`, times sent and received (ns), number, expiry (ns)."""
Response = tuple[int, Payload]
"""An entry of a client's queue: the sequence number of the request, and its response."""
Request = tuple["ClientEndpoint", int, Payload]
"""An entry of a service's queue: the client, the sequence number, and the request."""

# No dataclasses: importing the module and generating their methods would take a tenth of a short program's time.


class Endpoint:
    """A publisher or subscription in the graph. `topic` is fully qualified, `gid` has 16 bytes.

    The message class of another process's endpoint may be missing here; then only the type's name and hash are known
    (`RIHS01_...`).
    """

    def __init__(
        self,
        node: NodeId,
        topic: str,
        type_name: str,
        qos: Profile,
        gid: bytes,
        message_class: Any = None,
        type_hash: str | None = None,
    ) -> None:
        self.node = node
        self.topic = topic
        self.type_name = type_name
        self.qos = qos
        self.gid = gid
        self.message_class = message_class
        self.type_hash = type_hash


class SubscriptionEndpoint:
    """Receives messages: `queue` holds entries (message, sent ns, received ns, sequence number, expiry ns).

    The message may be `HeldMessage`; `take_queued` takes it.
    """

    def __init__(
        self, endpoint: Endpoint, raw: bool, queue: deque[Arrival], notify: Notify, on_event: OnEvent = no_event
    ) -> None:
        self.endpoint = endpoint
        self.raw = raw
        self.queue = queue
        self.notify = notify
        self.on_event = on_event
        self.matched = 0


class _ServiceEnd:
    """One end of a service; `notify` is called when something has been put into its `queue`."""

    def __init__(self, node: NodeId, name: str, type_name: str, notify: Notify, service_class: Any = None) -> None:
        self.node = node
        self.name = name
        self.type_name = type_name
        self.notify = notify
        self.service_class = service_class
        self.queue: deque[Any] = deque()


class ServiceEndpoint(_ServiceEnd):
    """Answers requests: `queue` holds (client, sequence number, request). `type_hash` is set if the server is in
    another process.
    """

    def __init__(
        self,
        node: NodeId,
        name: str,
        type_name: str,
        notify: Notify,
        service_class: Any = None,
        type_hash: str | None = None,
    ) -> None:
        super().__init__(node, name, type_name, notify, service_class)
        self.type_hash = type_hash


class ClientEndpoint(_ServiceEnd):
    """Sends requests: `queue` holds (sequence number, response)."""

    def __init__(
        self,
        node: NodeId,
        name: str,
        type_name: str,
        notify: Notify,
        service_class: Any = None,
        gid: bytes | None = None,
    ) -> None:
        super().__init__(node, name, type_name, notify, service_class)
        self.gid = gid or new_gid()
