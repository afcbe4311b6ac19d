"""Input on its way from the thread that reads it to the app: what has not been handled yet is merged.

Textual queues each mouse move, wheel step and resize. Handling one takes longer than making one, so a hand on the mouse
keeps the screen, and the keys behind, busy for many seconds.
"""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from itertools import takewhile
from typing import Any, cast

from textual import events
from textual.message import Message

MAX_WHEEL_STEPS = 8
"""How many steps of the mouse wheel may wait; as many as presses of one key."""

Wheel = (events.MouseScrollUp, events.MouseScrollDown, events.MouseScrollLeft, events.MouseScrollRight)
Mergeable = (events.MouseMove, events.Resize, *Wheel)


class InputQueue:
    """Gives the app what has come once it has handled what came before.

    Of mouse moves and resizes that wait with no key or click in between, the last one counts, and of wheel steps the
    last few.
    """

    def __init__(self, app: Any, loop: asyncio.AbstractEventLoop) -> None:
        """`loop` is the app's."""
        self._app = app
        self._loop = loop
        self._waiting: deque[Message] = deque()
        self._is_handling = False
        self._lock = threading.Lock()
        self._has_resized = False

    @property
    def is_idle(self) -> bool:
        """Whether the app has handled everything."""
        return not self._is_handling and not self._waiting

    def put(self, message: Message) -> None:
        """Pass on a message; from any thread, but from no signal handler."""
        with self._lock:
            merge(self._waiting, message)
            begins, self._is_handling = not self._is_handling, True
        if begins:
            self._loop.call_soon_threadsafe(self._hand_over)

    def resized(self, event: Callable[[], events.Resize]) -> None:
        """Pass on that the terminal was resized, with its size at the time when the app learns it.

        From a signal handler, where nothing may wait for a lock.
        """
        if not self._has_resized:
            self._has_resized = True
            self._loop.call_soon_threadsafe(self._put_resize, event)

    def _put_resize(self, event: Callable[[], events.Resize]) -> None:
        self._has_resized = False
        self.put(event())

    def _hand_over(self) -> None:
        with self._lock:
            batch = [*self._waiting]
            self._waiting.clear()
            self._is_handling = bool(batch)
        for each in batch:
            self._app.post_message(each)
        if batch:
            self._after_app(lambda: self._after_screen(lambda: self._after_app(self._hand_over)))

    def _after_app(self, then: Callable[[], None]) -> None:
        """Go on once the app has handled what it was given."""
        if not self._app.call_later(then):
            self._loop.call_soon(then)

    def _after_screen(self, then: Callable[[], None]) -> None:
        # The app passes mouse moves and resizes on to the screen.
        screens = self._app.screen_stack
        if not (screens and screens[-1].is_running and screens[-1].call_later(then)):
            then()


def merge(waiting: deque[Message], message: Message) -> None:
    """Append a message, and remove what it makes needless."""
    if isinstance(message, Mergeable):
        behind = list(takewhile(lambda each: isinstance(each, Mergeable), reversed(waiting)))
        if isinstance(message, Wheel):
            same = [each for each in behind if isinstance(each, Wheel)][MAX_WHEEL_STEPS - 1 :]
        else:
            same = [each for each in behind if isinstance(each, type(message))]
        for each in same:
            waiting.remove(each)
            if isinstance(message, events.MouseMove) and isinstance(each, events.MouseMove):
                later, earlier = cast(Any, message), cast(Any, each)
                later._delta_x += earlier._delta_x
                later._delta_y += earlier._delta_y
    waiting.append(message)
