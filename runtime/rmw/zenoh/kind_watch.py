"""One liveliness subscription per kind of token, shared by all watches of single topics or services.

Zenoh matches each received token against the keys of all subscriptions of the session: with hundreds of them this is
most of the cost of a large graph.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from bot_console.runtime.rmw.zenoh.declarations import TokenCallback
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.keys import mangle
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, tokens_of_kind, topic_part


class TopicTokens:
    """The token keys of one topic, and its watcher."""

    __slots__ = ("is_left", "keys", "lock", "seen")

    def __init__(self) -> None:
        self.lock = threading.RLock()  # one per row; reentrant, as the garbage collector may end a node at any point
        self.keys: dict[str, None] = {}
        self.seen: TokenCallback | None = None
        self.is_left = False
        """Whether another row has replaced this one, or will."""


class TopicWatch:
    """A watch of one topic."""

    def __init__(self, watch: KindWatch, topic: str, seen: TokenCallback) -> None:
        self._watch = watch
        self._topic = topic
        self._seen = seen

    def undeclare(self) -> None:
        """End the watch; does nothing if it already ended."""
        self._watch.unwatch(self._topic, self._seen)


class KindWatch:
    """The tokens of one kind, by topic or service; each topic's watcher parses its tokens."""

    def __init__(self, session: Session, kind: Kind) -> None:
        self._rows: dict[str, TopicTokens] = {}
        self._watch = session.watch_tokens(tokens_of_kind(session.domain, kind), self._on_token, apart=True)

    def watch(self, topic: str, seen: TokenCallback) -> TopicWatch:
        """Call back for each token of a topic that exists, appears or disappears.

        Call it without holding any lock that the removal of a node takes, as it may wait for a watcher that is being
        notified of another token.
        """
        self._take_waiting()

        def begin(row: TopicTokens) -> None:
            row.seen = seen
            for key in tuple(row.keys):
                seen(key, True)

        self._change(mangle(topic), begin)
        return TopicWatch(self, topic, seen)

    def unwatch(self, topic: str, seen: TokenCallback) -> None:
        """Stop notifying `seen`, if it is still the topic's watcher."""

        def end(row: TopicTokens) -> None:
            if row.seen is seen:
                row.seen = None

        self._change(mangle(topic), end)

    def known(self) -> list[str]:
        """Return the keys of the existing tokens that were reported."""
        self._take_waiting()
        return [key for row in list(self._rows.values()) for key in tuple(row.keys)]

    def _take_waiting(self) -> None:
        if self._watch.taking is not None:
            self._watch.taking.take_waiting()

    def _on_token(self, key: str, came: bool) -> None:
        part = topic_part(key)

        def change(row: TopicTokens) -> None:
            if came:
                row.keys[key] = None
            else:
                row.keys.pop(key, None)
            if row.seen is not None:
                row.seen(key, came)

        if part is not None:
            self._change(part, change)

    def _change(self, part: str, change: Callable[[TopicTokens], None]) -> None:
        """Change a topic's row, which exists only while it has tokens or a watcher."""
        while True:
            row = self._rows.get(part) or self._rows.setdefault(part, TopicTokens())
            with row.lock:
                if row.is_left:
                    continue
                change(row)
                if not row.keys and row.seen is None and not row.is_left:
                    row.is_left = True
                    del self._rows[part]
                return
