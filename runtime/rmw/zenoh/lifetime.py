"""The lifetime of a session: opening, reopening with the same declarations, and closing."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from typing import Any

from bot_console.runtime.rmw.zenoh.declaration_throttle import DeclarationThrottle
from bot_console.runtime.rmw.zenoh.declarations import Declaration

CLOSE_TIMEOUT_S = 0.4
"""How long `close` waits, in s; closing takes 2.5 s if the link to a frozen process is full."""


class Lifetime:
    """A session's declarations from opening to closing; subclasses open and close the session. Thread-safe."""

    _zenoh: Any
    """The Zenoh session, replaced when it is reopened."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._declared: dict[Declaration, None] = {}
        self._is_open = True  # each subclass opens it at once
        self._ended = False
        self._throttle = DeclarationThrottle()
        self.settled = threading.Event()
        """Cleared while the session is being reopened, until its links are up: what is sent earlier may reach nobody.
        """
        self.settled.set()

    @staticmethod
    def errors() -> type[Exception]:
        """Return Zenoh's error class; called only once an error was raised."""
        raise NotImplementedError

    def _shut(self) -> None:
        """Close the Zenoh session."""
        with contextlib.suppress(self.errors()):  # on a busy machine this times out after 10 s, but closes it
            self._zenoh.close()

    def _reopen(self, join: Callable[[], None]) -> bool:
        """Close, reopen with `join`, and declare everything again; returns False if it was closed for good meanwhile.

        This takes seconds if another process is frozen, and longer if opening fails and is retried. The lock is not
        held meanwhile, so that declaring, sending, querying and undeclaring do not wait. Entities declared meanwhile
        are created with the rest.
        """
        with self._lock:
            if self._ended:
                return False
            self._is_open = False
            self.settled.clear()
            for each in self._declared:
                each.on_links_lost()
        self._shut()
        join()
        with self._lock:
            self._is_open = not self._ended
            if self._is_open:
                for each in self._declared:
                    with contextlib.suppress(self.errors()):
                        each.inner = each.declare(self._zenoh)
                return True
        self._shut()
        return False

    def _settle(self) -> None:
        """Finish the declarations of a reopened session: its links are up, or will not come up."""
        with self._lock:
            declared = tuple(self._declared)
        for each in declared:
            each.on_links_restored()

    def close(self) -> None:
        """Close the session and its declarations; does nothing if it is already closed."""
        self.settled.set()
        with self._lock:
            self._ended = True
            if not self._is_open:
                return  # already closed, or being reopened, which then ends with closing
            self._is_open = False
        closing = threading.Thread(target=self._shut, name="zenoh-close", daemon=True)
        try:
            closing.start()
        except RuntimeError:  # the interpreter is ending, and Python 3.12 starts no thread then
            self._shut()
        else:
            closing.join(CLOSE_TIMEOUT_S)

    def is_closed(self) -> bool:
        """Whether the session was closed."""
        return self._ended

    def _declare(self, thing: Any) -> Any:
        with self._lock:
            if self._is_open:
                thing.inner = thing.declare(self._zenoh)
            if not self._ended:
                self._declared[thing] = None
        self._throttle.count_declaration()
        return thing

    def forget(self, thing: Declaration) -> None:
        """Undeclare an entity."""
        with self._lock:
            if thing in self._declared:
                del self._declared[thing]
                if self._is_open and thing.inner is not None:
                    thing.take_back()
