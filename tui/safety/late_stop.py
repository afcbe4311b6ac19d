"""A stop typed after keys that are still being handled: it does not wait for them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from functools import partial

from bot_console.tui.keymap import stops
from bot_console.tui.safety.stopping import Stopping
from textual import events

LATE_S = 0.25
"""Seconds for which such a key may wait for its turn. Keys typed before it may open a field in which it is a letter; on
a machine that takes longer for them the robot is rather held once too often.
"""


def in_a_while(look: Callable[[], None]) -> None:
    """Call back when a key has waited too long; not by a Textual timer, whose message would wait, too."""
    asyncio.get_running_loop().call_later(LATE_S, look)


class LateStop:
    """Holds the robot at once for a stop key that has to wait, and remembers that when its turn comes."""

    def __init__(
        self, stopping: Stopping, typing: Callable[[], bool], later: Callable[[Callable[[], None]], None] = in_a_while
    ) -> None:
        """`typing` says whether a text field has the focus; `later` runs something if a key waits too long."""
        self._stopping = stopping
        self._typing = typing
        self.later = later
        self._waiting: list[events.Key] = []
        self._done: list[events.Key] = []

    def waits(self, event: events.Event) -> None:
        """Take note of a key that has to wait for those before it."""
        if isinstance(event, events.Key) and stops(event.key):
            self._waiting.append(event)
            self.later(partial(self._look, event))

    def was_done(self, event: events.Key) -> bool:
        """Whether a key whose turn has come has already held the robot, and is not a letter of a text."""
        if event in self._waiting:
            self._waiting.remove(event)
        if event not in self._done:
            return False
        self._done.remove(event)
        return not self._typing()

    def _look(self, event: events.Key) -> None:
        if event not in self._waiting:
            return
        if self._typing():
            self.later(partial(self._look, event))
        elif not self._stopping.held_here:
            self._waiting.remove(event)
            self._done.append(event)
            self._stopping.hold()
