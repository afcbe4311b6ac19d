"""The part of the graph that this process watches: tokens of other processes under a key, as they come and go."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable

from bot_console.runtime.rmw.zenoh.declarations import TokenWatch
from bot_console.runtime.rmw.zenoh.graph_snapshot import Known, watch_all
from bot_console.runtime.rmw.zenoh.kind_watch import KindWatch, TopicWatch
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, Token, parse_token, tokens_of

Listener = Callable[[Token, bool], None]
"""Called with a token that appeared (True) or disappeared; it may only append to a queue and wake a thread."""

SINGLE = 48
"""How many topics or services of each kind are watched one by one, so that Zenoh's own threads report at once: as many
as a robot in one process has. All others share one watch per kind, which reports up to 0.05 s later.
"""


class GraphCache:
    """The tokens of other sessions under one key; listeners are notified of existing tokens and of every change."""

    def __init__(
        self,
        session: Session,
        key: str | None,
        *,
        known: Known | None = None,
        refused: Callable[[str], None] = lambda key: None,
    ) -> None:
        """If `known` is given, all existing tokens are added at once; `refused` is called with a new key that is not a
        token.

        Without a key nothing is declared: an existing watch, passed to `set_watch`, calls `on_token`.
        """
        self._refused = refused
        self._own = session.zid
        self._lock = threading.RLock()
        self._tokens: dict[str, Token] = {}
        self._listeners: list[Listener] = []
        self._declared: TokenWatch | TopicWatch | None = None
        if key is not None:
            self._declared = (
                watch_all(session, key, self.on_token, known) if known else session.watch_tokens(key, self.on_token)
            )

    def set_watch(self, watch: TopicWatch) -> None:
        """Set the watch that reports these tokens."""
        self._declared = watch

    def on_token(self, key: str, came: bool) -> None:
        """Handle a token that appeared or disappeared; ignores invalid tokens, and those of this session."""
        if came and key in self._tokens:  # most arrive twice: as a reply to the query, and through the watch
            return
        try:
            token = parse_token(key)
        except FormatError:
            if came:
                self._refused(key)
            return
        if token.node.zid == self._own:
            return
        with self._lock:
            if came == (key in self._tokens):
                return
            if came:
                self._tokens[key] = token
            else:
                del self._tokens[key]
            for listener in tuple(self._listeners):
                # With the lock held, so that no listener sees a change before an earlier one.
                listener(token, came)

    def listen(self, listener: Listener) -> None:
        """Notify a listener of the existing tokens and of all changes from now on."""
        with self._lock:
            self._listeners.append(listener)
            for token in tuple(self._tokens.values()):
                listener(token, True)

    def forget(self, listener: Listener) -> bool:
        """Remove a listener; return whether none is left."""
        with self._lock:
            if listener in self._listeners:
                self._listeners.remove(listener)
            return not self._listeners

    def tokens(self) -> list[Token]:
        """Return the existing tokens."""
        with self._lock:
            return list(self._tokens.values())

    def close(self) -> None:
        """End the watch."""
        if self._declared is not None:
            self._declared.undeclare()


class Watches:
    """The watches for this process's endpoints: one for each topic or service of each kind, shared."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._lock = threading.RLock()  # reentrant, as the garbage collector may end a node at any point
        self._seen: dict[tuple[Kind, str], GraphCache] = {}
        self._single: Counter[Kind] = Counter()
        self._kinds: dict[Kind, KindWatch] = {}
        self._served: set[tuple[Kind, str]] = set()
        """The topics and services served by the watch of their kind."""
        self._has_forgotten = False

    def listen(self, kind: Kind, topic: str, listener: Listener) -> GraphCache:
        """Notify a listener of the tokens of one kind for one topic or service."""
        serving: KindWatch | None = None
        with self._lock:
            seen = self._seen.get((kind, topic))
            if seen is None:
                serving = self._watch_of(kind)
                key = tokens_of(self._session.domain, kind, topic)
                seen = self._seen[kind, topic] = GraphCache(self._session, None if serving else key)
                if serving:
                    self._served.add((kind, topic))
                else:
                    self._single[kind] += 1
        if serving:
            seen.set_watch(serving.watch(topic, seen.on_token))
        seen.listen(listener)
        return seen

    def _watch_of(self, kind: Kind) -> KindWatch | None:
        """Return the watch for one more topic of a kind; None while there are few, each with a watch of its own."""
        if self._single[kind] < SINGLE:
            return None
        if kind not in self._kinds:
            self._kinds[kind] = KindWatch(self._session, kind)
        return self._kinds[kind]

    def forget(self, kind: Kind, topic: str, listener: Listener) -> None:
        """Remove a listener."""
        with self._lock:
            seen = self._seen.get((kind, topic))
            if seen is None or not seen.forget(listener):
                return
            del self._seen[kind, topic]
            if (kind, topic) in self._served:
                self._served.remove((kind, topic))
            else:
                self._single[kind] -= 1
                self._has_forgotten = True
        seen.close()

    def known(self) -> list[str] | None:
        """Return all existing tokens that were reported; None if that is incomplete because a watch has ended."""
        with self._lock:
            if self._has_forgotten:
                return None
            singly = [seen for each, seen in self._seen.items() if each not in self._served]
            kinds = [*self._kinds.values()]
        keys = [token.key for seen in singly for token in seen.tokens()]
        return keys + [key for each in kinds for key in each.known()]
