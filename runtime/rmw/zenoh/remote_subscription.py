"""Receives messages of other processes into a subscription's queue."""

from __future__ import annotations

import time
from collections.abc import Container

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.endpoints import HeldMessage, Payload, SubscriptionEndpoint, Tap, depth
from bot_console.runtime.rmw.zenoh.congestion_control import BLOCKING_TOPICS
from bot_console.runtime.rmw.zenoh.declarations import Declaration
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.type_agreement import has_same_type
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of, key_hash_of, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.runtime.rmw.zenoh.wire.tokens import Token
from bot_console.runtime.rosidl.cdr import CdrError, deserialize

KEEP_ALL_DEPTH = 1000
"""How many of a latching publisher's messages a subscription with KEEP_ALL requests."""


class RemotePublisher:
    """A publisher in another process, as a subscription knows it."""

    def __init__(self) -> None:
        self.fits = True
        self.number = 0
        """Sequence number of its last message."""
        self.lifespan: int | None = None
        """In ns; None means no limit."""
        self.lease: int | None = None
        """In ns; None means no limit."""


class ReceivedPayload(HeldMessage):
    """A received payload; the thread that takes the message deserializes it, so that the link is drained without delay.

    A payload that a full queue drops is never deserialized.
    """

    __slots__ = ("_payload", "_peeked", "_remote_subscription")

    def __init__(self, remote_subscription: RemoteSubscription, payload: bytes) -> None:
        self._remote_subscription = remote_subscription
        self._payload = payload
        self._peeked: Payload | None = None

    def peek(self) -> Payload | None:
        """Return the message for reading only; None if it is malformed."""
        self._peeked = self.take()
        return self._peeked

    def take(self) -> Payload | None:
        """Deserialize and return the message; None if it is malformed."""
        if self._peeked is not None:
            return self._peeked
        try:
            return deserialize(self._payload, self._remote_subscription.message_class)
        except CdrError as error:
            self._remote_subscription.report_unreadable(error)
            return None


class RemoteSubscription:
    """Receives messages from other processes for one subscription."""

    def __init__(
        self, session: Session, subscription: SubscriptionEndpoint, key: str, own: Container[bytes], tap: Tap
    ) -> None:
        """`own` holds the ids of this process's publishers, whose messages are passed as objects."""
        self._subscription = subscription
        self._raw = subscription.raw
        self._counts_overruns = subscription.endpoint.topic in BLOCKING_TOPICS
        self._opened_ns = 0
        """Start of reception (system time, ns); of the messages sent before it, only as many come as fit into the
        queue.
        """
        self._tap = tap
        self._own = own
        self.message_class = subscription.endpoint.message_class
        self._key = key
        self._key_hash = key_hash_of(key)
        self._publishers: dict[bytes, RemotePublisher] = {}
        self._process = current()
        self._session = session
        self._declared: Declaration | None = None
        qos = subscription.endpoint.qos
        self._wants_history = qos.durability.name in ("TRANSIENT_LOCAL", "BEST_AVAILABLE")

    def open(self) -> None:
        """Start receiving."""
        self._opened_ns = time.time_ns()
        qos = self._subscription.endpoint.qos
        history = (depth(qos) or KEEP_ALL_DEPTH) if self._wants_history else None
        reliable = qos.reliability.name != "BEST_EFFORT"
        self._declared = self._session.declare_subscriber(self._key, self.on_sample, reliable=reliable, history=history)

    def on_sample(self, payload: bytes, attachment: bytes | None) -> None:
        """Handle a message, on one of Zenoh's threads."""
        subscription = self._subscription
        try:
            number, stamp, gid = unpack(attachment, payload, self._key_hash)
            # The history query also reaches the caches of this session, whatever `allowed_origin` is.
            if gid in self._own:
                return
            publisher = self._publishers.get(gid)
            if publisher is None:
                # Its first message can arrive before its token.
                publisher = self._publishers[gid] = RemotePublisher()
            # A latched message can arrive twice: when it is published, and from the publisher's cache.
            if not publisher.fits or (self._wants_history and number <= publisher.number):
                return
            if publisher.number and number > publisher.number + 1:
                self._lost(number - publisher.number - 1)
            publisher.number = number
        except FormatError as error:
            self.report_unreadable(error)
            return
        message = payload if self._raw else ReceivedPayload(self, payload)
        expires = None if publisher.lifespan is None else stamp + publisher.lifespan
        queue = subscription.queue
        if self._counts_overruns and stamp >= self._opened_ns and len(queue) == queue.maxlen:
            self._overrun()
        queue.append((message, stamp, time.time_ns(), number, expires))
        subscription.notify()
        observer = self._tap.observer
        if observer is not None:
            observer(subscription.endpoint, gid, number, stamp, payload)

    def report_unreadable(self, error: Exception) -> None:
        """Report a message that cannot be read."""
        notify(self._process, f"a message on '{self._subscription.endpoint.topic}' was dropped: {error}")

    def _lost(self, count: int) -> None:
        endpoint = self._subscription.endpoint
        self._session.lost += count
        self._subscription.on_event("lost", count)
        if endpoint.qos.reliability.name == "RELIABLE":
            notify(
                self._process,
                f"messages of '{endpoint.topic}' were lost between processes: they are published faster than they can "
                "be taken; publish less often, or use KEEP_ALL on the publisher",
            )

    def _overrun(self) -> None:
        """Count a message that was overwritten on a topic whose readers need every one, and report it once."""
        queue, topic = self._subscription.queue, self._subscription.endpoint.topic
        self._session.lost += 1
        self._subscription.on_event("lost", 1)
        notify(
            self._process,
            f"messages of '{topic}' come faster than they are taken; of more than {queue.maxlen} the oldest go",
        )

    def on_token(self, token: Token, came: bool) -> None:
        """Handle a publisher of another process that appeared or disappeared."""
        subscription = self._subscription
        endpoint = subscription.endpoint
        if not has_same_type(self._process, endpoint, self._key, token, came):
            return
        gid = gid_of(token.key)
        if came:
            publisher = self._publishers.setdefault(gid, RemotePublisher())
            rules = self._session.qos_rules(token.node.zid)
            policy = rules.incompatible_policy(token.qos, endpoint.qos)
            publisher.fits = not policy
            publisher.lifespan = rules.lifespan(token.qos)
            if policy:
                subscription.on_event("incompatible", policy)
        else:
            publisher = self._publishers.pop(gid, RemotePublisher())
        if not publisher.fits:
            return
        subscription.matched += 1 if came else -1
        subscription.on_event("matched", 1 if came else -1)
        subscription.on_event("alive" if came else "gone", publisher)

    def close(self) -> None:
        """Stop receiving."""
        if self._declared is not None:
            self._declared.undeclare()
