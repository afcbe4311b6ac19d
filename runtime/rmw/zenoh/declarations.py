"""A session's declarations, which survive its reopening and do nothing while no session is open.

A session may be reopened (`MeshSession.rejoin`) without its nodes being aware of it, so nothing here raises merely
because no session is open at the moment.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.channel_worker import ChannelWorker

Received = Callable[[bytes, "bytes | None"], None]
"""Called with the payload and the attachment of a sample."""

TokenCallback = Callable[[str, bool], None]
"""Called with the key of a liveliness token and whether it appeared (True) or disappeared."""

Declare = Callable[[Any], Any]
"""Declares an entity in a Zenoh session and returns it."""


class DeclarationOwner(Protocol):
    """What a declaration needs of its session."""

    settled: threading.Event

    def forget(self, thing: Declaration) -> None:
        """Undeclare an entity."""
        ...

    def errors(self) -> type[Exception]:
        """Zenoh's error class; only asked for once an error was raised."""
        ...


UNDECLARE_TIMEOUT_S = 1.0
"""How long undeclaring waits for an entity in use, in seconds; after that, the end of the session undeclares it."""

TAKEN = "Already mutably borrowed"
"""The error message of Zenoh's binding when another thread is undeclaring the entity being used."""


class Declaration:
    """An entity declared by a session; `declare` creates it in a Zenoh session."""

    def __init__(self, session: DeclarationOwner, declare: Declare) -> None:
        self._session = session
        self.declare = declare
        self.inner: Any = None
        """The Zenoh entity; None while no session is open."""

    def undeclare(self) -> None:
        """Undeclare the entity; does nothing if it was already undeclared."""
        self._session.forget(self)

    def take_back(self) -> None:
        """Undeclare the Zenoh entity, retrying for `UNDECLARE_TIMEOUT_S` while another thread is sending with it."""
        until = time.monotonic() + UNDECLARE_TIMEOUT_S
        while time.monotonic() < until:
            try:
                self.inner.undeclare()
                return
            except RuntimeError:  # Zenoh's binding says "Already borrowed"
                time.sleep(0.0005)

    def on_links_lost(self) -> None:
        """Prepare for new links: the old ones were cut."""

    def on_links_restored(self) -> None:
        """Finish, as the new links are up."""


class Publisher(Declaration):
    """Sends payloads to the subscribers of a key."""

    def put(self, payload: bytes, attachment: bytes) -> bool:
        """Send one sample; waits at most `WAIT_BEFORE_DROP_US` for a full link.

        Returns False if it could not be sent because the session is closed or rejoining, or because another thread is
        undeclaring the publisher.
        """
        inner = self.inner
        if inner is None:
            return False
        try:
            inner.put(payload, attachment=attachment)
        except self._session.errors():
            return False
        except RuntimeError as error:
            if str(error) != TAKEN:
                raise
            return False
        return True

    def put_surely(self, payload: bytes, attachment: bytes) -> bool:
        """Send one sample; waits for the links of a session that is being reopened, so call it in a separate thread."""
        settled = self._session.settled
        while True:
            if not settled.is_set():
                settled.wait()
            if self.put(payload, attachment):
                return True
            if settled.is_set():
                return False


class Querier(Declaration):
    """Queries the queryables of a key; `ask` makes the Zenoh call with (inner, payload, attachment, replied, done)."""

    def __init__(self, session: DeclarationOwner, declare: Declare, ask: Callable[..., None]) -> None:
        super().__init__(session, declare)
        self._ask = ask

    def get(self, payload: bytes, attachment: bytes, replied: Received, done: Callable[[], None] | None = None) -> bool:
        """Send a query; `replied` is called with each reply, and `done`, if given, after the last one or the timeout.

        Returns False if no query was sent because the session is closed or rejoining; then `done` is not called.
        """
        inner = self.inner
        if inner is None or not self._session.settled.is_set():
            return False
        try:
            self._ask(inner, payload, attachment, replied, done)
        except self._session.errors():
            return False
        return True


class TokenWatch(Declaration):
    """Watches tokens and reports each one once when it appears and once when it disappears.

    When a session is closed, Zenoh does not report the tokens that disappear with its links. Therefore the tokens that
    have not appeared again once the new links are up are reported as gone.
    """

    taking: ChannelWorker | None = None
    """The thread that takes the samples, if Zenoh's own threads do not."""

    def __init__(self, session: DeclarationOwner, declare: Declare, seen: TokenCallback) -> None:
        super().__init__(session, declare)
        self._seen = seen
        self._is_querying = False
        self._gone_since_query: set[str] = set()
        self._lock = threading.RLock()
        self._existing: set[str] = set()
        self._unconfirmed: set[str] = set()

    def on_token(self, key: str, came: bool) -> None:
        """Report that a token appeared or disappeared, with the lock held to keep the order of reports."""
        with self._lock:
            self._unconfirmed.discard(key)
            if came:
                self._existing.add(key)
                self._gone_since_query.discard(key)
            else:
                self._existing.discard(key)
                if self._is_querying:
                    self._gone_since_query.add(key)
            self._seen(key, came)

    def begin_query(self) -> None:
        """Begin a query for the existing tokens: record those that disappear from now on; no reply may restore them."""
        self._is_querying = True

    def add_existing(self, keys: Iterable[str]) -> None:
        """Handle a reply: report its tokens as existing, except those that have disappeared since the query."""
        for key in keys:
            with self._lock:
                if key not in self._gone_since_query:
                    self._unconfirmed.discard(key)
                    self._existing.add(key)
                    self._seen(key, True)

    def end_query(self) -> None:
        """End the query: all replies have arrived."""
        with self._lock:
            self._is_querying = False
            self._gone_since_query.clear()

    def on_links_lost(self) -> None:
        """Expect each token to appear again, as the links were cut."""
        with self._lock:
            self._unconfirmed = set(self._existing)

    def on_links_restored(self) -> None:
        """Report the tokens that have not appeared again as gone, as the new links are up."""
        with self._lock:
            for key in tuple(self._unconfirmed):
                self.on_token(key, False)


class Query:
    """A received request: call `answer` once, or `drop`."""

    __slots__ = ("_error", "_key", "_query", "attachment", "payload")

    def __init__(self, query: Any, key: str, payload: bytes, attachment: bytes | None, error: type[Exception]) -> None:
        """`error` is Zenoh's error class."""
        self._query = query
        self._key = key
        self._error = error
        self.payload = payload
        self.attachment = attachment

    def answer(self, payload: bytes, attachment: bytes) -> bool:
        """Send the only reply; returns False if the session that received the request is closed."""
        try:
            with self._query as query:
                query.reply(self._key, payload, attachment=attachment)
        except self._error:
            return False
        return True

    def drop(self) -> None:
        """End the request without a reply."""
        self._query.drop()
