"""A session's declarations, which survive its being reopened, and are inert while no session is open.

A session is reopened beneath nodes that know nothing of it (`MeshSession.rejoin`), so nothing here raises because there
is
none at the moment.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.apart import Taking

Received = Callable[[bytes, "bytes | None"], None]
"""Called with the payload and the attachment of a sample."""

TokenSeen = Callable[[str, bool], None]
"""Called with the key of a liveliness token, and whether it came (or went)."""

Declare = Callable[[Any], Any]
"""Makes a thing in a session of Zenoh's and gives it."""


class Keeper(Protocol):
    """The session of what is declared."""

    settled: threading.Event

    def forget(self, thing: Declared) -> None:
        """Take back what was declared."""
        ...

    def errors(self) -> type[Exception]:
        """The class of Zenoh's errors; asked for when something was raised."""
        ...


LENT_FOR = 1.0
"""Seconds for which something that is to be taken back may be in use; then it is left to the end of the session."""

TAKEN = "Already mutably borrowed"
"""What Zenoh's binding says where another thread is just taking back what is used."""


class Declared:
    """Something that a session has declared; `declare` makes it in a Zenoh session."""

    def __init__(self, session: Keeper, declare: Declare) -> None:
        self._session = session
        self.declare = declare
        self.inner: Any = None
        """What Zenoh has made of it; None while no session is open."""

    def undeclare(self) -> None:
        """Take it back; a second time does nothing."""
        self._session.forget(self)

    def take_back(self) -> None:
        """Take back what Zenoh has made of it, once no other thread is just sending with it: until then it is lent."""
        until = time.monotonic() + LENT_FOR
        while time.monotonic() < until:
            try:
                self.inner.undeclare()
                return
            except RuntimeError:  # "Already borrowed", by Zenoh's binding
                time.sleep(0.0005)

    def begin_again(self) -> None:
        """The links that it had are cut, and made anew."""

    def settle(self) -> None:
        """The new links are there."""


class Publisher(Declared):
    """Sends payloads to the subscribers of a key."""

    def put(self, payload: bytes, attachment: bytes) -> bool:
        """Send one sample; waits at most `WAIT_BEFORE_DROP` for a link that is full.

        False where it could not be sent, because the session is closed or just rejoins, or as another thread is just
        taking the publisher back.
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
        """Send one sample once the session has its links, if it is just opened anew: for a thread of its own."""
        settled = self._session.settled
        while True:
            if not settled.is_set():
                settled.wait()
            if self.put(payload, attachment):
                return True
            if settled.is_set():
                return False


class Querier(Declared):
    """Asks the queryables of a key; `ask` is how, as Zenoh wants it: (inner, payload, attachment, replied, done)."""

    def __init__(self, session: Keeper, declare: Declare, ask: Callable[..., None]) -> None:
        super().__init__(session, declare)
        self._ask = ask

    def get(self, payload: bytes, attachment: bytes, replied: Received, done: Callable[[], None]) -> bool:
        """Ask; `replied` gets each reply, and `done` is called when all have replied or the time is over.

        False where it was not asked, because the session is closed or just rejoins; then `done` is not called.
        """
        inner = self.inner
        if inner is None or not self._session.settled.is_set():
            return False
        try:
            self._ask(inner, payload, attachment, replied, done)
        except self._session.errors():
            return False
        return True


class TokenWatch(Declared):
    """Looks at tokens and hands on each that comes or goes, once.

    Zenoh does not say which of them go with the links of a session that is closed. Those that have not come again
    when the new links are there have gone.
    """

    taking: Taking | None = None
    """The thread that takes them, where one does that apart."""

    def __init__(self, session: Keeper, declare: Declare, seen: TokenSeen) -> None:
        super().__init__(session, declare)
        self._seen = seen
        self._is_asked = False
        self._gone: set[str] = set()
        self._lock = threading.RLock()
        self._there: set[str] = set()
        self._not_again: set[str] = set()

    def saw(self, key: str, came: bool) -> None:
        """A token came or went; with a lock held, so that its coming and going are told in their order."""
        with self._lock:
            self._not_again.discard(key)
            if came:
                self._there.add(key)
                self._gone.discard(key)
            else:
                self._there.discard(key)
                if self._is_asked:
                    self._gone.add(key)
            self._seen(key, came)

    def begin_question(self) -> None:
        """It is asked for what is there: from now on it is noted what goes, so that no answer brings it back."""
        self._is_asked = True

    def found(self, keys: Iterable[str]) -> None:
        """An answer: those that were there, but for what has gone since."""
        for key in keys:
            with self._lock:
                if key not in self._gone:
                    self._not_again.discard(key)
                    self._there.add(key)
                    self._seen(key, True)

    def end_question(self) -> None:
        """All answers are in."""
        with self._lock:
            self._is_asked = False
            self._gone.clear()

    def begin_again(self) -> None:
        """The links are cut: each token is to come again."""
        with self._lock:
            self._not_again = set(self._there)

    def settle(self) -> None:
        """The new links are there: what has not come again has gone."""
        with self._lock:
            for key in tuple(self._not_again):
                self.saw(key, False)


class Query:
    """A request that has come in: `answer` once, or `drop`."""

    __slots__ = ("_error", "_key", "_query", "attachment", "payload")

    def __init__(self, query: Any, key: str, payload: bytes, attachment: bytes | None, error: type[Exception]) -> None:
        """`error` is the class of what Zenoh raises."""
        self._query = query
        self._key = key
        self._error = error
        self.payload = payload
        self.attachment = attachment

    def answer(self, payload: bytes, attachment: bytes) -> bool:
        """Send the one reply; False where the session over which the request came is closed."""
        try:
            with self._query as query:
                query.reply(self._key, payload, attachment=attachment)
        except self._error:
            return False
        return True

    def drop(self) -> None:
        """End the request without a reply."""
        self._query.drop()
