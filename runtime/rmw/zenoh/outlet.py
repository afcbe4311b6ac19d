"""The way of a publisher's messages to other processes: serialized where somebody there wants them."""

from __future__ import annotations

from collections import deque
from typing import Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import SubscriptionEndpoint, depth
from bot_console.runtime.rmw.local_publisher import LocalPublisher
from bot_console.runtime.rmw.qos_matching import incompatible_policy
from bot_console.runtime.rmw.zenoh.declared import Publisher
from bot_console.runtime.rmw.zenoh.same_type import has_same_type
from bot_console.runtime.rmw.zenoh.sender import Sender
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.attachment import pack
from bot_console.runtime.rmw.zenoh.wire.tokens import Token

ALL_KEPT = 1000
"""How many messages a latching publisher keeps for others where its profile says all."""


PATIENT_TOPICS = frozenset({"/rosout"})
"""Reliable topics of which nothing is dropped whatever their depth: who reads a log counts on each of its lines."""


class Outlet(deque[Any]):
    """Stands among the local subscriptions of a publisher as the one for all other processes.

    What the publisher puts into its queue goes out at once; what must not be dropped (reliable, and keep all or lines
    of the log) does from another thread, so that the publisher does not wait. A latching publisher's messages always
    do: those who come later get them from the session, not from the program.
    """

    def __init__(self, session: Session, sender: Sender, publisher: LocalPublisher, key: str) -> None:
        super().__init__()
        self._session = session
        self._publisher = publisher
        self._key = key
        self._topic = publisher.endpoint.topic
        self.gid = publisher.endpoint.gid
        self._out: Publisher | None = None
        self._process = current()
        self._sender = sender
        qos = publisher.endpoint.qos
        all_count = qos.history.name == "KEEP_ALL" or publisher.endpoint.topic in PATIENT_TOPICS
        self._patient = all_count and qos.reliability.name != "BEST_EFFORT"
        self._target = SubscriptionEndpoint(publisher.endpoint, True, self, _nothing)
        self.latching = publisher.history is not None
        if self.latching:
            self._open()
            publisher.send_elsewhere(self._target)

    def append(self, entry: Any) -> None:
        """Send one message that the publisher has serialized."""
        data, stamp, number, _ = entry
        out = self._out or self._open()
        attachment = pack(number, stamp, self.gid, data)
        if self._patient:
            self._sender.send(out, self._topic, data, attachment)
        else:
            out.put(data, attachment)

    def _open(self) -> Publisher:
        qos = self._publisher.endpoint.qos
        cache = (depth(qos) or ALL_KEPT) if self.latching else 0
        reliable = qos.reliability.name != "BEST_EFFORT"
        self._out = self._session.declare_publisher(self._key, reliable=reliable, cache=cache, patient=self._patient)
        return self._out

    def saw(self, token: Token, came: bool) -> None:
        """A subscription of another process came or went."""
        publisher = self._publisher
        endpoint = publisher.endpoint
        if not has_same_type(self._process, endpoint, self._key, token, came):
            return
        policy = incompatible_policy(endpoint.qos, token.qos)
        if policy:
            if came:
                publisher.on_event("incompatible", policy)
            return
        publisher.elsewhere += 1 if came else -1
        if not self.latching:
            publisher.send_elsewhere(self._target if publisher.elsewhere else None)
        publisher.on_event("matched", 1 if came else -1)

    def send_again(self) -> None:
        """Give the session, which was opened anew, what a latching publisher has kept."""
        self._publisher.late(self._target)

    def close(self) -> None:
        """Send nothing any more."""
        self._publisher.send_elsewhere(None)
        if self._out is not None:
            self._sender.undeclare(self._out)


def _nothing() -> None:
    """What is sent wakes nobody here."""
