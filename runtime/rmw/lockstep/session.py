"""A process's session in a stepped run: its declarations and messages go through the coordinator's switchboard."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

from bot_console.runtime.rmw.lockstep.switchboard import Operation
from bot_console.runtime.rmw.zenoh.declarations import (
    Declaration,
    Publisher,
    Querier,
    Query,
    Received,
    TokenCallback,
    TokenWatch,
)
from bot_console.runtime.rmw.zenoh.session import Session

Send = Callable[[Operation], None]


class LinkError(Exception):
    """Stands in for Zenoh's error class; never raised, as this link cannot fail."""


class Link:
    """A process's side of the switchboard, shared by its sessions of all domains."""

    def __init__(self, send: Send, process: int) -> None:
        """`send(operation)` passes an operation to the switchboard; `process` is a number unique in the run."""
        self.send = send
        self.process = process
        self.published_elsewhere: Callable[[], int] = lambda: 0
        """How many messages other processes have published, as far as this one knows."""
        self.numbers = itertools.count(1)
        self.subscriptions: dict[str, dict[int, Received]] = {}
        self.served: dict[str, dict[int, Callable[[Query], None]]] = {}
        self.waiting: dict[int, Received] = {}
        self.tokens: dict[str, None] = {}
        self.watches: dict[int, tuple[re.Pattern[str], TokenWatch]] = {}

    def take(self, operation: Operation) -> None:
        """Handle an operation that the switchboard delivers."""
        kind, *rest = operation
        if kind == "sample":
            key, payload, attachment = rest
            for received in tuple(self.subscriptions.get(key, {}).values()):
                received(payload, attachment)
        elif kind == "token":
            self.see(*rest)
        elif kind == "kept":
            key, number, payload, attachment = rest
            if number in self.subscriptions.get(key, {}):
                self.subscriptions[key][number](payload, attachment)
        elif kind == "query":
            process, number, key, payload, attachment = rest
            inner = _Request(self.send, process, number)
            for asked in tuple(self.served.get(key, {}).values()):
                asked(Query(inner, key, payload, attachment, LinkError))
        elif kind == "reply":
            number, payload, attachment = rest
            if number in self.waiting:
                self.waiting[number](payload, attachment)

    def see(self, key: str, exists: bool) -> None:
        """Handle the appearance or disappearance of another process's token."""
        if exists:
            self.tokens[key] = None
        else:
            self.tokens.pop(key, None)
        for pattern, watch in tuple(self.watches.values()):
            if pattern.fullmatch(key):
                watch.on_token(key, exists)


class LockstepSession(Session):
    """The session of one domain."""

    timeout_s = 0.0
    never_waits = True

    def __init__(self, domain: int, link: Link) -> None:
        super().__init__(domain)
        self.zid = f"{1 << 127 | link.process << 32 | domain:032x}"
        self._zenoh = self._link = link

    @staticmethod
    def errors() -> type[Exception]:
        """Return an error class that is never raised."""
        return LinkError

    def _shut(self) -> None:
        """Do nothing: the switchboard removes the process when it ends."""

    def declare_publisher(
        self, key: str, *, reliable: bool = True, cache: int = 0, blocking: bool = False
    ) -> Publisher:
        """Declare a publisher; the switchboard keeps up to `cache` of its latest samples for late subscribers."""
        return self._declare(Publisher(self, lambda link: _Publisher(link, key, cache)))

    def declare_subscriber(
        self, key: str, received: Received, *, reliable: bool = True, history: int | None = None
    ) -> Declaration:
        """Declare a subscriber; it gets up to `history` of the latest samples that publishers have kept."""

        def declare(link: Link) -> _Entry:
            entry = _Entry(link, link.subscriptions, "subscribe", key, received)
            if history:
                link.send(("history", key, entry.number, history))
            return entry

        return self._declare(Declaration(self, declare))

    def declare_queryable(self, key: str, asked: Callable[[Query], None]) -> Declaration:
        """Declare a queryable that answers the requests of a key."""
        return self._declare(Declaration(self, lambda link: _Entry(link, link.served, "serve", key, asked)))

    def declare_querier(self, key: str, timeout: float) -> Querier:
        """Declare a querier of a key's queryables in other processes; a request waits for its answer indefinitely."""

        def ask(
            querier: _Querier, payload: bytes, attachment: bytes, replied: Received, done: Callable[[], None] | None
        ) -> None:
            querier.ask(payload, attachment, replied)

        return self._declare(Querier(self, lambda link: _Querier(link, key), ask))

    def declare_token(self, key: str) -> Declaration:
        """Declare a liveliness token, which exists until it is undeclared or this process ends."""
        return self._declare(Declaration(self, lambda link: _Token(link, key)))

    def watch_tokens(self, key: str, seen: TokenCallback, *, apart: bool = False) -> TokenWatch:
        """Call back for each token that exists, appears or disappears; `key` may have wildcards."""

        def declare(link: Link) -> _TokenWatchEntry:
            return _TokenWatchEntry(link, _pattern(key), watch)

        watch = TokenWatch(self, declare, seen)
        return self._declare(watch)

    def collect_tokens(self, key: str, timeout: float) -> tuple[list[str], bool]:
        """Return the tokens that exist."""
        pattern = _pattern(key)
        return [each for each in self._link.tokens if pattern.fullmatch(each)], True

    def linked(self) -> set[str]:
        """Return no ids: the coordinator's report of who is there needs no confirmation by links."""
        return set()

    def is_really_gone(self, zid: str, pid: int | None) -> bool:
        """Return True: a link is lost only when its process ends."""
        return True


@lru_cache(1024)
def _pattern(key: str) -> re.Pattern[str]:
    """Return a regular expression for a key with wildcards: `*` matches one part, `/**` at the end any number."""
    head, any_rest, _ = key.partition("/**")
    parts = ("[^/]*" if each == "*" else re.escape(each).replace(r"\*", "[^/]*") for each in head.split("/"))
    return re.compile("/".join(parts) + ("(?:/.*)?" if any_rest else ""))


class _Querier:
    def __init__(self, link: Link, key: str) -> None:
        self._link, self._key = link, key
        self._asked: list[int] = []

    def ask(self, payload: bytes, attachment: bytes, replied: Received) -> None:
        number = next(self._link.numbers)

        def take(payload: bytes, attachment: bytes | None) -> None:
            del self._link.waiting[number]
            self._asked.remove(number)
            replied(payload, attachment)

        self._link.waiting[number] = take
        self._asked.append(number)
        self._link.send(("query", number, self._key, payload, attachment))

    def undeclare(self) -> None:
        for number in self._asked:
            del self._link.waiting[number]
        self._asked.clear()


class _Publisher:
    def __init__(self, link: Link, key: str, kept: int) -> None:
        self._send = link.send
        self._number = next(link.numbers)
        self._key = key
        self._keeps = bool(kept)
        if kept:
            link.send(("keep", self._number, key, kept))

    def put(self, payload: bytes, *, attachment: bytes) -> None:
        self._send(("put", self._number, self._key, payload, attachment))

    def undeclare(self) -> None:
        if self._keeps:
            self._send(("forget", self._number))


class _Entry:
    """A callback of this process for a key; the switchboard knows only whether a key has any."""

    def __init__(self, link: Link, entries: dict[str, dict[int, Any]], kind: str, key: str, callback: object) -> None:
        self.number = next(link.numbers)
        self._send, self._entries, self._kind, self._key = link.send, entries, kind, key
        if key not in entries:
            entries[key] = {}
            link.send((kind, key, True))
        entries[key][self.number] = callback

    def undeclare(self) -> None:
        del self._entries[self._key][self.number]
        if not self._entries[self._key]:
            del self._entries[self._key]
            self._send((self._kind, self._key, False))


class _Token:
    def __init__(self, link: Link, key: str) -> None:
        self._link, self._key = link, key
        link.send(("token", key, True))
        link.see(key, True)

    def undeclare(self) -> None:
        self._link.send(("token", self._key, False))
        self._link.see(self._key, False)


class _TokenWatchEntry:
    def __init__(self, link: Link, pattern: re.Pattern[str], watch: TokenWatch) -> None:
        self._link = link
        self._number = next(link.numbers)
        link.watches[self._number] = pattern, watch
        for key in tuple(link.tokens):
            if pattern.fullmatch(key):
                watch.on_token(key, True)

    def undeclare(self) -> None:
        self._link.watches.pop(self._number, None)


class _Request:
    """A request from another process; plays the role of Zenoh's query."""

    def __init__(self, send: Send, process: int, number: int) -> None:
        self._answer = partial(self._reply, send, process, number)

    def __enter__(self) -> _Request:
        return self

    def __exit__(self, *_error: object) -> None:
        return

    def reply(self, _key: str, payload: bytes, *, attachment: bytes) -> None:
        self._answer(payload, attachment)

    @staticmethod
    def _reply(send: Send, process: int, number: int, payload: bytes, attachment: bytes) -> None:
        send(("reply", process, number, payload, attachment))

    def drop(self) -> None:
        """Do nothing: the client keeps waiting, or has gone."""
