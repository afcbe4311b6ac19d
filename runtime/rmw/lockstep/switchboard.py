"""Delivers the messages, requests and graph entries of the processes of a stepped run."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable
from typing import Any

Operation = tuple[Any, ...]
Deliver = Callable[[Operation], None]
Sample = tuple[bytes, bytes]
"""Payload and attachment."""


class Peer:
    """A process of the run."""

    def __init__(self, switchboard: Switchboard, number: int, deliver: Deliver) -> None:
        self._switchboard = switchboard
        self.number = number
        self.deliver = deliver
        self.tokens: dict[str, None] = {}
        self.subscribed: set[str] = set()
        self.served: set[str] = set()
        self.kept: dict[int, tuple[str, deque[Sample]]] = {}
        """The last messages of its latching publishers."""
        self.published = 0

    def handle(self, operation: Operation) -> None:
        """Carry out an operation that the process has sent."""
        self._switchboard.handle(self, operation)

    def leave(self) -> None:
        """Remove what the process had in the graph, as it has ended."""
        self._switchboard.remove(self)


class Switchboard:
    """The coordinator's side. Called only by threads that have the turn, one at a time."""

    def __init__(self) -> None:
        self._peers: dict[int, Peer] = {}
        self._numbers = itertools.count()
        self._handlers: dict[str, Callable[..., None]] = {
            "token": self._token,
            "subscribe": self._subscribe,
            "serve": self._serve,
            "history": self._history,
            "keep": self._keep,
            "forget": self._forget,
            "put": self._put,
            "query": self._query,
            "reply": self._reply,
            "published": self._published,
        }

    def add(self, deliver: Deliver) -> Peer:
        """Add a process; `deliver(operation)` is called with its operations, first with those of the existing graph."""
        peer = Peer(self, next(self._numbers), deliver)
        for other in self._peers.values():
            for key in other.tokens:
                deliver(("token", key, True))
        self._peers[peer.number] = peer
        return peer

    def remove(self, peer: Peer) -> None:
        """Remove a process; does nothing if it was already removed."""
        if self._peers.pop(peer.number, None) is None:
            return
        for key in peer.tokens:
            self._deliver_to_others(peer, ("token", key, False))

    def handle(self, peer: Peer, operation: Operation) -> None:
        """Carry out an operation."""
        self._handlers[operation[0]](peer, *operation[1:])

    def published(self) -> int:
        """Return how many messages the processes have reported as published."""
        return sum(each.published for each in self._peers.values())

    def _published(self, peer: Peer, count: int) -> None:
        peer.published = count

    def _others(self, peer: Peer) -> list[Peer]:
        return [each for each in self._peers.values() if each is not peer]

    def _deliver_to_others(self, peer: Peer, operation: Operation) -> None:
        for each in self._others(peer):
            each.deliver(operation)

    def _token(self, peer: Peer, key: str, exists: bool) -> None:
        if exists:
            peer.tokens[key] = None
        else:
            peer.tokens.pop(key, None)
        self._deliver_to_others(peer, ("token", key, exists))

    def _subscribe(self, peer: Peer, key: str, wanted: bool) -> None:
        (peer.subscribed.add if wanted else peer.subscribed.discard)(key)

    def _serve(self, peer: Peer, key: str, served: bool) -> None:
        (peer.served.add if served else peer.served.discard)(key)

    def _history(self, peer: Peer, key: str, subscription: int, count: int) -> None:
        for other in self._others(peer):
            for kept_key, samples in other.kept.values():
                if kept_key == key:
                    for payload, attachment in list(samples)[-count:]:
                        peer.deliver(("kept", key, subscription, payload, attachment))

    def _keep(self, peer: Peer, publisher: int, key: str, count: int) -> None:
        peer.kept[publisher] = key, deque(maxlen=count)

    def _forget(self, peer: Peer, publisher: int) -> None:
        peer.kept.pop(publisher, None)

    def _put(self, peer: Peer, publisher: int, key: str, payload: bytes, attachment: bytes) -> None:
        kept = peer.kept.get(publisher)
        if kept is not None:
            kept[1].append((payload, attachment))
        for other in self._peers.values():
            if key in other.subscribed and other is not peer:
                other.deliver(("sample", key, payload, attachment))

    def _query(self, peer: Peer, number: int, key: str, payload: bytes, attachment: bytes) -> None:
        for other in self._others(peer):
            if key in other.served:
                other.deliver(("query", peer.number, number, key, payload, attachment))

    def _reply(self, _peer: Peer, process: int, number: int, payload: bytes, attachment: bytes) -> None:
        asker = self._peers.get(process)
        if asker is not None:
            asker.deliver(("reply", number, payload, attachment))
