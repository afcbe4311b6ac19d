"""Drains a Zenoh channel in a thread of its own, which yields the interpreter to others in between."""

from __future__ import annotations

import atexit
import threading
import time
import weakref
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Protocol

WAITING = 100_000
"""Samples that a channel may hold: 5,000 nodes that come at once. When it is full, Zenoh's thread waits."""
TURN = 0.003
"""Seconds for which samples are taken one after the other."""
PAUSE = 0.003
"""Seconds between two such turns, for the threads that deal with keys and stops."""
QUIET = 0.05
"""Longest wait (s) for the next sample, where none has come for some time."""


class Channel(Protocol):
    """What a session's channel offers."""

    def try_recv(self) -> Any:
        """The next sample; None when there is none now. Raises where none comes any more."""
        ...


class Taking(threading.Thread):
    """Hands samples on in their order until the channel raises `ended`.

    It looks for them now and then rather than wait in Zenoh: a thread that the interpreter's end finds in there ends
    the program with an abort, for what is unwound then is not Python's alone.
    """

    def __init__(self, channel: Channel, take: Callable[[Any], None], ended: type[Exception]) -> None:
        super().__init__(name="zenoh-tokens", daemon=True)
        self._channel = channel
        self._take = take
        self._ended = ended
        self._over = threading.Event()
        self._lock = threading.RLock()

    def run(self) -> None:
        """Take samples until there is an end."""
        wait = 0.0
        with suppress(self._ended):
            while not self._over.wait(wait):
                wait = PAUSE if self._turn() else min(wait * 1.5 + 0.001, QUIET)

    def take_waiting(self) -> None:
        """Take at once all that is there, in the caller's thread."""
        with self._lock, suppress(self._ended):
            while (sample := self._channel.try_recv()) is not None:
                self._take(sample)

    def end(self) -> None:
        """Take no more, and be gone."""
        self._over.set()
        self.join(1.0)

    def _turn(self) -> bool:
        """Take what is there, for no longer than a turn; whether there was something."""
        until = time.monotonic() + TURN
        found = False
        with self._lock:
            while (sample := self._channel.try_recv()) is not None:
                found = True
                self._take(sample)
                if time.monotonic() >= until:
                    break
        return found


_all: weakref.WeakSet[Taking] = weakref.WeakSet()


def take_apart(channel: Channel, take: Callable[[Any], None], ended: type[Exception]) -> Taking:
    """Hand samples on in their order until the channel raises `ended`, in the thread that is given back."""
    taking = Taking(channel, take, ended)
    _all.add(taking)
    taking.start()
    return taking


@atexit.register
def _end_all() -> None:
    for each in list(_all):
        each.end()
