"""The lifetime of a session: opened, reopened beneath its declarations, which survive that, and closed."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from typing import Any

from bot_console.runtime.rmw.zenoh.declared import Declared
from bot_console.runtime.rmw.zenoh.pace import Pace

CLOSING = 0.4
"""How long closing is waited for, in s: it takes 2.5 s beside a frozen process to which the link is full."""


class Lifetime:
    """What a session has declared, from its opening to its end; a subclass opens and shuts. From any thread."""

    _zenoh: Any
    """Zenoh's session, which another one takes the place of when it is opened anew."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._declared: dict[Declared, None] = {}
        self._is_open = True  # each subclass opens at once
        self._ended = False
        self._pace = Pace()
        self.settled = threading.Event()
        """Not set while the session is opened anew, until its links are there: what is sent before may reach nobody."""
        self.settled.set()

    @staticmethod
    def errors() -> type[Exception]:
        """The class of Zenoh's errors; asked for when something was raised."""
        raise NotImplementedError

    def _shut(self) -> None:
        """Close Zenoh's session."""
        with contextlib.suppress(self.errors()):  # on a busy machine it gives up after 10 s, and is closed all the same
            self._zenoh.close()

    def _reopen(self, join: Callable[[], None]) -> bool:
        """Close, open anew by `join`, and declare all again; False where it was closed for good meanwhile.

        That takes seconds beside a frozen process, and more where opening fails and is tried again: nobody who
        declares, sends, asks or takes back waits for it. What is declared meanwhile is made when all is.
        """
        with self._lock:
            if self._ended:
                return False
            self._is_open = False
            self.settled.clear()
            for each in self._declared:
                each.begin_again()
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
        """The links of a session that was opened anew are there, or will not come."""
        with self._lock:
            declared = tuple(self._declared)
        for each in declared:
            each.settle()

    def close(self) -> None:
        """Leave; what was declared is gone. A second time does nothing."""
        self.settled.set()
        with self._lock:
            self._ended = True
            if not self._is_open:
                return  # closed, or just being opened anew, which then ends in being closed
            self._is_open = False
        closing = threading.Thread(target=self._shut, name="zenoh-close", daemon=True)
        closing.start()
        closing.join(CLOSING)

    def is_closed(self) -> bool:
        """Whether it was closed."""
        return self._ended

    def _declare(self, thing: Any) -> Any:
        with self._lock:
            if self._is_open:
                thing.inner = thing.declare(self._zenoh)
            if not self._ended:
                self._declared[thing] = None
        self._pace.shown()
        return thing

    def forget(self, thing: Declared) -> None:
        """Take back what was declared."""
        with self._lock:
            if thing in self._declared:
                del self._declared[thing]
                if self._is_open and thing.inner is not None:
                    thing.take_back()
