"""Drain a Zenoh channel in a separate thread that regularly yields the interpreter to the others."""

from __future__ import annotations

import atexit
import threading
import time
import weakref
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Protocol

from bot_console.runtime.process.virtual.child_threads import start_outside

MAX_WAITING_SAMPLES = 100_000
"""Capacity of a channel in samples: enough for 5,000 nodes that appear at once. Zenoh's thread waits while it is full.
"""
TURN_S = 0.003
"""How long samples are taken without a break, in seconds."""
PAUSE_S = 0.003
"""Break between two turns, in seconds, which leaves the interpreter to the threads that handle keys and stops."""
MAX_POLL_S = 0.05
"""Longest interval between two polls of an idle channel, in seconds."""


class Channel(Protocol):
    """The part of a Zenoh channel's interface that is used here."""

    def try_recv(self) -> Any:
        """Return the next sample, or None if none is available now. Raises once the channel is closed."""
        ...


class ChannelWorker(threading.Thread):
    """Pass samples to a callback, in order, until the channel raises `ended`.

    The thread polls instead of blocking inside Zenoh: if the interpreter shut down while the thread was blocked there,
    unwinding its stack through foreign frames would abort the program.
    """

    def __init__(self, channel: Channel, take: Callable[[Any], None], ended: type[Exception]) -> None:
        super().__init__(name="zenoh-tokens", daemon=True)
        self._channel = channel
        self._take = take
        self._ended = ended
        self._over = threading.Event()
        self._lock = threading.RLock()

    def run(self) -> None:
        """Take samples until the channel is closed or `end` is called."""
        wait = 0.0
        with suppress(self._ended):
            while not self._over.wait(wait):
                wait = PAUSE_S if self._turn() else min(wait * 1.5 + 0.001, MAX_POLL_S)

    def take_waiting(self) -> None:
        """Take all available samples now, in the caller's thread."""
        with self._lock, suppress(self._ended):
            while (sample := self._channel.try_recv()) is not None:
                self._take(sample)

    def end(self) -> None:
        """Stop taking samples and join the thread, for at most 1 s."""
        self._over.set()
        self.join(1.0)

    def _turn(self) -> bool:
        """Take available samples for at most `TURN_S`; return whether there were any."""
        until = time.monotonic() + TURN_S
        found = False
        with self._lock:
            while (sample := self._channel.try_recv()) is not None:
                found = True
                self._take(sample)
                if time.monotonic() >= until:
                    break
        return found


_all: weakref.WeakSet[ChannelWorker] = weakref.WeakSet()


def drain_in_worker(channel: Channel, take: Callable[[Any], None], ended: type[Exception]) -> ChannelWorker:
    """Start and return a thread that passes samples to `take`, in order, until the channel raises `ended`."""
    taking = ChannelWorker(channel, take, ended)
    _all.add(taking)
    start_outside(taking)
    return taking


@atexit.register
def _end_all() -> None:
    for each in list(_all):
        each.end()
