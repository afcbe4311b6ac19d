"""A publisher of this process: each message is copied or serialized once, then put into each subscription's queue."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from functools import cache
from typing import Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import (
    Endpoint,
    Notify,
    OnEvent,
    Payload,
    SharedMessage,
    SubscriptionEndpoint,
    Tap,
    depth,
)
from bot_console.runtime.rmw.qos_matching import INFINITE, LATCHING

Aim = tuple[tuple[SubscriptionEndpoint, ...], Callable[[Payload], bytes] | None]
"""The receivers, and the serializer if none of them needs the message object. Replaced as a whole."""


class LocalPublisher:
    """A publisher of this process."""

    __slots__ = (
        *(
            "_aim",
            "_lifespan",
            "_lock",
            "_now",
            "_number",
            "_remote_publisher",
            "_tap",
            "elsewhere",
            "endpoint",
            "history",
        ),
        *("lease", "on_event", "on_publish", "open"),
    )

    def __init__(
        self, endpoint: Endpoint, on_event: OnEvent, lock: threading.RLock, tap: Tap, lifespan: int | None
    ) -> None:
        """`lifespan` is how long its messages stay valid, in ns; None for ever."""
        self.endpoint = endpoint
        self._tap = tap
        self._lock = lock
        self.on_event = on_event
        self.on_publish: Notify | None = None
        """Called for each message, if somebody is watching."""
        manual = endpoint.qos.liveliness.name == "MANUAL_BY_TOPIC"
        lease = endpoint.qos.liveliness_lease_duration.nanoseconds
        self.lease: int | None = lease if manual and lease not in INFINITE else None
        """How long (ns) it counts as alive without asserting its liveliness; None for as long as it exists."""
        self._aim: Aim = (), None
        self._remote_publisher: SubscriptionEndpoint | None = None
        self.elsewhere = 0
        """Number of matched subscriptions in other processes."""
        self.open = True
        self._number = 0
        # Looked up once: a publisher keeps the process in which it was created, and so that process's clock.
        self._now = current().clock.system_ns
        self._lifespan = lifespan
        keeps = endpoint.qos.durability.name in LATCHING
        self.history: deque[Any] | None = deque(maxlen=depth(endpoint.qos)) if keeps else None

    @property
    def targets(self) -> tuple[SubscriptionEndpoint, ...]:
        """The matched subscriptions, replaced when the graph changes."""
        return self._aim[0]

    @targets.setter
    def targets(self, targets: tuple[SubscriptionEndpoint, ...]) -> None:
        in_bytes = bool(targets) and self.history is None and all(each.raw for each in targets)
        self._aim = targets, _codec().serialize if in_bytes else None

    def publish(self, message: Payload) -> None:
        """Send the message's current content; refuses one that cannot be sent even if there is no subscription.

        If all receivers want bytes, as other processes do, the message is only serialized; otherwise it is copied.
        """
        if self.open:
            targets, write = self._aim
            if write is None:
                self._give(targets, message._copy_())
            else:
                self._give(targets, message, write(message))

    def publish_own(self, message: Payload) -> bool:
        """Publish a well-formed message that nobody else holds: it is not copied unless needed.

        Returns False if the publisher is closed.
        """
        if self.open:
            self._give(self._aim[0], message)
        return self.open

    def skip(self) -> None:
        """Count a message that was not created because nobody would receive it; it still asserts liveliness."""
        if self.open:
            if self.lease is not None or self.on_publish is not None:
                self.assert_liveliness()
            self._number += 1

    def _give(self, targets: tuple[SubscriptionEndpoint, ...], message: Payload, data: bytes | None = None) -> None:
        """Put a message, or its bytes, into each target's queue; the message then belongs to the middleware."""
        if self.lease is not None or self.on_publish is not None:
            self.assert_liveliness()
        history, observer = self.history, self._tap.observer
        self._number = number = self._number + 1
        if not targets and history is None and observer is None:
            return
        stamp = self._now()
        takers = len(targets)
        if history is not None:
            history.append((message, stamp, number))
            takers += 1  # the kept message is never taken
        if observer is not None:
            takers += 1
        expires = stamp + self._lifespan if self._lifespan else None
        # The last taker gets the message itself; the others get copies, which are made only if they take it.
        given = SharedMessage(message, takers) if takers > 1 else message
        for target in targets:
            if target.raw and data is None:
                data = _codec().serialize(message)
            target.queue.append((data if target.raw else given, stamp, stamp, number, expires))
            target.notify()
        if observer is not None:
            observer(self.endpoint, self.endpoint.gid, number, stamp, message if data is None else data)

    def publish_raw(self, data: bytes) -> None:
        """Publish serialized data, deserialized for subscriptions that want a message."""
        self.publish(_codec().deserialize(data, self.endpoint.message_class))

    def assert_liveliness(self) -> None:
        """Assert the publisher's liveliness."""
        if self.on_publish is not None:
            self.on_publish()
        if self.lease is not None:
            for target in self.targets:
                target.on_event("asserted", self)

    def matched_count(self) -> int:
        """Number of matched subscriptions, including other processes'."""
        return len(self.targets) - (self._remote_publisher is not None) + self.elsewhere

    def is_heard(self) -> bool:
        """Whether anybody receives what is published: a subscription, here or elsewhere, or an observer."""
        return bool(self.targets) or self._tap.observer is not None

    def send_elsewhere(self, remote_publisher: SubscriptionEndpoint | None) -> None:
        """Set the target that receives each message, serialized, for other processes; None if none subscribes."""
        with self._lock:
            if remote_publisher is self._remote_publisher or not self.open:
                return
            targets = tuple(each for each in self.targets if each is not self._remote_publisher)
            self._remote_publisher = remote_publisher
            self.targets = targets if remote_publisher is None else (*targets, remote_publisher)

    @property
    def published(self) -> int:
        """Number of messages published."""
        return self._number

    def late(self, target: SubscriptionEndpoint) -> None:
        """Send the kept messages to a subscription that has just been added."""
        now = self._now()
        for message, stamp, number in tuple(self.history or ()):  # a copy, as another thread may publish meanwhile
            expires = stamp + self._lifespan if self._lifespan else None
            if expires is None or now <= expires:
                given = _codec().serialize(message) if target.raw else message._copy_()
                target.queue.append((given, stamp, now, number, expires))
        if target.queue:
            target.notify()


@cache
def _codec() -> Any:
    """Return the codec, imported only when bytes are needed."""
    from bot_console.runtime.rosidl import cdr

    return cdr
