"""Sends a publisher's messages to other processes, serialized only if one of them subscribes."""

from __future__ import annotations

from collections import deque
from typing import Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import SubscriptionEndpoint, depth
from bot_console.runtime.rmw.local_publisher import LocalPublisher
from bot_console.runtime.rmw.zenoh.congestion_control import must_not_drop
from bot_console.runtime.rmw.zenoh.declarations import Publisher
from bot_console.runtime.rmw.zenoh.sender import Sender
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.type_agreement import has_same_type
from bot_console.runtime.rmw.zenoh.wire.attachment import key_hash_of, pack
from bot_console.runtime.rmw.zenoh.wire.tokens import Token

KEEP_ALL_DEPTH = 1000
"""How many messages a latching publisher with KEEP_ALL keeps for subscribers in other processes."""


class RemotePublisher(deque[Any]):
    """The queue, among a publisher's local subscriptions, that represents all other processes.

    A message that the publisher appends is sent at once, but one that must not be dropped (reliable and KEEP_ALL, at
    least `DEEP_QUEUE` deep, or a log line) is sent by another thread, so that the publisher does not wait. A latching
    publisher's messages are always sent: late subscribers get them from the session, not from the program.
    """

    def __init__(self, session: Session, sender: Sender, publisher: LocalPublisher, key: str) -> None:
        super().__init__()
        self._session = session
        self._publisher = publisher
        self._key = key
        self._key_hash = key_hash_of(key)
        self._topic = publisher.endpoint.topic
        self.gid = publisher.endpoint.gid
        self._out: Publisher | None = None
        self._process = current()
        self._incompatible: set[str] = set()
        """The tokens of the present subscriptions that do not match."""
        self._sender = sender
        endpoint = publisher.endpoint
        self._blocking = must_not_drop(endpoint.topic, endpoint.qos) and not session.never_waits
        self._target = SubscriptionEndpoint(publisher.endpoint, True, self, _nothing)
        self.latching = publisher.history is not None
        if self.latching:
            self._open()
            publisher.send_elsewhere(self._target)

    def append(self, entry: Any) -> None:
        """Send one message, which the publisher has serialized."""
        data, stamp, _, number, _ = entry
        out = self._out or self._open()
        attachment = pack(number, stamp, self.gid, data, self._key_hash)
        if self._blocking:
            self._sender.send(out, self._topic, data, attachment)
        else:
            out.put(data, attachment)

    def _open(self) -> Publisher:
        qos = self._publisher.endpoint.qos
        cache = (depth(qos) or KEEP_ALL_DEPTH) if self.latching else 0
        reliable = qos.reliability.name != "BEST_EFFORT"
        self._out = self._session.declare_publisher(self._key, reliable=reliable, cache=cache, blocking=self._blocking)
        return self._out

    def on_token(self, token: Token, came: bool) -> None:
        """Handle a subscription of another process that appeared or disappeared."""
        publisher = self._publisher
        endpoint = publisher.endpoint
        if not has_same_type(self._process, endpoint, self._key, token, came):
            return
        if came:
            rules = self._session.qos_rules(token.node.zid)
            if policy := rules.incompatible_policy(endpoint.qos, token.qos):
                self._incompatible.add(token.key)
                publisher.on_event("incompatible", policy)
                return
        elif token.key in self._incompatible:
            self._incompatible.remove(token.key)
            return
        publisher.elsewhere += 1 if came else -1
        if not self.latching:
            publisher.send_elsewhere(self._target if publisher.elsewhere else None)
        publisher.on_event("matched", 1 if came else -1)

    def send_again(self) -> None:
        """Publish the messages that a latching publisher has kept to the reopened session."""
        self._publisher.late(self._target)

    def close(self) -> None:
        """Stop sending."""
        self._publisher.send_elsewhere(None)
        if self._out is not None:
            self._sender.undeclare(self._out)


def _nothing() -> None:
    """Notify nobody: what is sent has no reader in this process."""
