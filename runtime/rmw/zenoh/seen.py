"""The part of the graph this process watches: other processes' tokens under a key, as they appear and vanish."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable

from bot_console.runtime.rmw.zenoh.declared import TokenWatch
from bot_console.runtime.rmw.zenoh.kind_watch import KindWatch, Look
from bot_console.runtime.rmw.zenoh.present import Known, watch_all
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, Token, parse_token, tokens_of

Listener = Callable[[Token, bool], None]
"""Called with a token that came (True) or went; it may append and wake, and nothing else."""

SINGLE = 48
"""So many topics or services of each kind are watched singly, told at once from Zenoh's own threads: what a robot in
one process has. From then on one watch for the kind serves the others, which hear of what comes up to 0.05 s later.
"""


class SeenTokens:
    """The tokens of other sessions under one key; a listener hears of those that are there and of every change."""

    def __init__(
        self,
        session: Session,
        key: str | None,
        *,
        known: Known | None = None,
        refused: Callable[[str], None] = lambda key: None,
    ) -> None:
        """With `known` all that is there is seen at once; `refused` is called with a key that came and is no token.

        Without a key nothing is watched: `saw` is told by a watch that is there, whose look is given to `told_by`.
        """
        self._refused = refused
        self._own = session.zid
        self._lock = threading.RLock()
        self._tokens: dict[str, Token] = {}
        self._listeners: list[Listener] = []
        self._declared: TokenWatch | Look | None = None
        if key is not None:
            self._declared = watch_all(session, key, self.saw, known) if known else session.watch_tokens(key, self.saw)

    def told_by(self, look: Look) -> None:
        """It is this look that tells of its tokens."""
        self._declared = look

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
        if self._declared is not None:
            self._declared.undeclare()


class Watches:
    """What is looked at for the endpoints of this process: each topic or service of each kind once, shared."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._lock = threading.RLock()  # the garbage collector ends nodes in the middle of anything
        self._seen: dict[tuple[Kind, str], SeenTokens] = {}
        self._single: Counter[Kind] = Counter()
        self._kinds: dict[Kind, KindWatch] = {}
        self._served: set[tuple[Kind, str]] = set()
        """Those that a watch of their kind serves."""
        self._has_forgotten = False

    def listen(self, kind: Kind, topic: str, listener: Listener) -> SeenTokens:
        """Tell a listener of the tokens of one kind for one topic or service."""
        serving: KindWatch | None = None
        with self._lock:
            seen = self._seen.get((kind, topic))
            if seen is None:
                serving = self._watch_of(kind)
                key = tokens_of(self._session.domain, kind, topic)
                seen = self._seen[kind, topic] = SeenTokens(self._session, None if serving else key)
                if serving:
                    self._served.add((kind, topic))
                else:
                    self._single[kind] += 1
        if serving:
            seen.told_by(serving.look(topic, seen.saw))
        seen.listen(listener)
        return seen

    def _watch_of(self, kind: Kind) -> KindWatch | None:
        """The watch that serves one more of a kind; None while there are few, which are watched singly."""
        if self._single[kind] < SINGLE:
            return None
        if kind not in self._kinds:
            self._kinds[kind] = KindWatch(self._session, kind)
        return self._kinds[kind]

    def forget(self, kind: Kind, topic: str, listener: Listener) -> None:
        """Tell a listener no more."""
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
        """All tokens that were told and are there; None where that is not known, for some are looked at no more."""
        with self._lock:
            if self._has_forgotten:
                return None
            singly = [seen for each, seen in self._seen.items() if each not in self._served]
            kinds = [*self._kinds.values()]
        keys = [token.key for seen in singly for token in seen.tokens()]
        return keys + [key for each in kinds for key in each.known()]
