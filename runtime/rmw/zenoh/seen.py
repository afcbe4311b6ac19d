"""What this process looks at of the graph: the tokens of other processes under a key, as they come and go."""

from __future__ import annotations

import threading
from collections.abc import Callable

from bot_console.runtime.rmw.zenoh.declared import TokenWatch
from bot_console.runtime.rmw.zenoh.present import Known, watch_all
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, Token, parse_token, tokens_of

Listener = Callable[[Token, bool], None]
"""Called with a token that came (True) or went; it may append and wake, and nothing else."""


class SeenTokens:
    """The tokens of other sessions under one key; a listener hears of those that are there and of every change."""

    def __init__(
        self,
        session: Session,
        key: str,
        *,
        known: Known | None = None,
        refused: Callable[[str], None] = lambda key: None,
    ) -> None:
        """With `known` all that is there is seen at once; `refused` is called with a key that came and is no token."""
        self._refused = refused
        self._own = session.zid
        self._lock = threading.RLock()
        self._tokens: dict[str, Token] = {}
        self._listeners: list[Listener] = []
        self._declared: TokenWatch = (
            watch_all(session, key, self.saw, known) if known else session.watch_tokens(key, self.saw)
        )

    def saw(self, key: str, came: bool) -> None:
        """A token came or went; one that is no token of the format is ignored, as are those of this session."""
        if came and key in self._tokens:  # most come twice: by the question, and to who looks
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
                # With the lock held, so that nobody hears of a change before the state that it changes.
                listener(token, came)

    def listen(self, listener: Listener) -> None:
        """Tell a listener of what is there, and of all changes from now on."""
        with self._lock:
            self._listeners.append(listener)
            for token in tuple(self._tokens.values()):
                listener(token, True)

    def forget(self, listener: Listener) -> bool:
        """Tell a listener no more; whether nobody listens now."""
        with self._lock:
            if listener in self._listeners:
                self._listeners.remove(listener)
            return not self._listeners

    def tokens(self) -> list[Token]:
        """Those that are there."""
        with self._lock:
            return list(self._tokens.values())

    def close(self) -> None:
        """Look no more."""
        self._declared.undeclare()


class Watches:
    """What is looked at for the endpoints of this process: one key for each topic or service and kind, shared."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._lock = threading.RLock()  # the garbage collector ends nodes in the middle of anything
        self._seen: dict[tuple[Kind, str], SeenTokens] = {}
        self._has_forgotten = False

    def listen(self, kind: Kind, topic: str, listener: Listener) -> SeenTokens:
        """Tell a listener of the tokens of one kind for one topic or service."""
        with self._lock:
            seen = self._seen.get((kind, topic))
            if seen is None:
                seen = SeenTokens(self._session, tokens_of(self._session.domain, kind, topic))
                self._seen[kind, topic] = seen
        seen.listen(listener)
        return seen

    def forget(self, kind: Kind, topic: str, listener: Listener) -> None:
        """Tell a listener no more."""
        with self._lock:
            seen = self._seen.get((kind, topic))
            if seen is None or not seen.forget(listener):
                return
            del self._seen[kind, topic]
            self._has_forgotten = True
        seen.close()

    def known(self) -> list[str] | None:
        """All tokens that were told and are there; None where that is not known, for some are looked at no more."""
        with self._lock:
            each_seen = None if self._has_forgotten else [*self._seen.values()]
        return None if each_seen is None else [token.key for seen in each_seen for token in seen.tokens()]
