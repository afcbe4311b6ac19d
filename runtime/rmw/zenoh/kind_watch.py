"""One liveliness subscription per kind of token, shared by those interested in single topics or services.

Zenoh compares each token it receives with the key of each subscription of the session: with hundreds of subscriptions
that
is most of the cost of a large graph.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from bot_console.runtime.rmw.zenoh.declared import TokenSeen
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.keys import mangled
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, tokens_of_kind, topic_part


class Row:
    """The keys of the tokens of one topic, and who looks at them."""

    __slots__ = ("is_left", "keys", "lock", "seen")

    def __init__(self) -> None:
        self.lock = threading.RLock()  # one each, and not to wait for: a node may be ended in the middle of anything
        self.keys: dict[str, None] = {}
        self.seen: TokenSeen | None = None
        self.is_left = False
        """Whether another row is, or will be, the topic's."""


class Look:
    """Somebody's look at one topic."""

    def __init__(self, watch: KindWatch, topic: str, seen: TokenSeen) -> None:
        self._watch = watch
        self._topic = topic
        self._seen = seen

    def undeclare(self) -> None:
        """Look no more; a second time does nothing."""
        self._watch.look_away(self._topic, self._seen)


class KindWatch:
    """The tokens of one kind by topic or service; those of a topic are read by who looks at it."""

    def __init__(self, session: Session, kind: Kind) -> None:
        self._rows: dict[str, Row] = {}
        self._watch = session.watch_tokens(tokens_of_kind(session.domain, kind), self._saw, apart=True)

    def look(self, topic: str, seen: TokenSeen) -> Look:
        """Call back for each token of a topic that is there, comes or goes.

        Not with a lock held that the end of a node takes: it is waited for who is just told of others.
        """
        self._take_waiting()

        def begin(row: Row) -> None:
            row.seen = seen
            for key in tuple(row.keys):
                seen(key, True)

        self._change(mangled(topic), begin)
        return Look(self, topic, seen)

    def look_away(self, topic: str, seen: TokenSeen) -> None:
        """Tell one no more, if it is still the one that looks."""

        def end(row: Row) -> None:
            if row.seen is seen:
                row.seen = None

        self._change(mangled(topic), end)

    def known(self) -> list[str]:
        """The keys of the tokens that were told and are there."""
        self._take_waiting()
        return [key for row in list(self._rows.values()) for key in tuple(row.keys)]

    def _take_waiting(self) -> None:
        if self._watch.taking is not None:
            self._watch.taking.take_waiting()

    def _saw(self, key: str, came: bool) -> None:
        part = topic_part(key)

        def change(row: Row) -> None:
            if came:
                row.keys[key] = None
            else:
                row.keys.pop(key, None)
            if row.seen is not None:
                row.seen(key, came)

        if part is not None:
            self._change(part, change)

    def _change(self, part: str, change: Callable[[Row], None]) -> None:
        """Change a topic's row, which is there only while it has tokens or somebody looks."""
        while True:
            row = self._rows.get(part) or self._rows.setdefault(part, Row())
            with row.lock:
                if row.is_left:
                    continue
                change(row)
                if not row.keys and row.seen is None and not row.is_left:
                    row.is_left = True
                    del self._rows[part]
                return
