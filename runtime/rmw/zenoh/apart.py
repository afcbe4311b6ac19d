"""Takes what a channel of Zenoh's holds in a thread of its own, which leaves the interpreter to others in between."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any, Protocol

WAITING = 100_000
"""Samples that a channel may hold: 5,000 nodes that come at once. When it is full, Zenoh's thread waits."""
TURN = 0.003
"""Seconds for which samples are taken one after the other."""
PAUSE = 0.003
"""Seconds between two such turns, for the threads that deal with keys and stops."""


class Channel(Protocol):
    """What a session's channel offers."""

    def recv(self) -> Any:
        """The next sample; waits for it without the interpreter. Raises where none comes any more."""
        ...

    def try_recv(self) -> Any:
        """The next sample; None when there is none now. Raises where none comes any more."""
        ...


def take_apart(channel: Channel, take: Callable[[Any], None], ended: type[Exception]) -> threading.Thread:
    """Hand samples on in their order until the channel raises `ended`, in the thread that is given back."""

    def run() -> None:
        try:
            while True:
                take(channel.recv())
                _turn(channel, take)
        except ended:
            return

    thread = threading.Thread(target=run, name="zenoh-tokens", daemon=True)
    thread.start()
    return thread


def _turn(channel: Channel, take: Callable[[Any], None]) -> None:
    """What waits, turn by turn; a sample that comes alone is followed by no pause."""
    until = time.monotonic() + TURN
    while (sample := channel.try_recv()) is not None:
        take(sample)
        if time.monotonic() >= until:
            time.sleep(PAUSE)
            until = time.monotonic() + TURN
