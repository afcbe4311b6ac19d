"""Passes input from the reading thread to the app, and merges what has not been handled yet.

Textual queues each mouse move, wheel step and resize. Handling one takes longer than producing one, so a moving mouse
would keep the screen and the keys behind it busy for many seconds.
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
"""Maximum number of waiting wheel steps; the same as for repeated presses of one key."""

Wheel = (events.MouseScrollUp, events.MouseScrollDown, events.MouseScrollLeft, events.MouseScrollRight)
Mergeable = (events.MouseMove, events.Resize, *Wheel)


class InputQueue:
    """Passes new input to the app once the earlier input is handled.

    Of the waiting mouse moves and resizes with no key or click in between, only the last is kept; of wheel steps, the
    last few.
    """

    def __init__(self, app: Any, loop: asyncio.AbstractEventLoop) -> None:
        """`loop` is the app's event loop."""
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
        """Pass on a message. May be called from any thread, but not from a signal handler."""
        with self._lock:
            merge(self._waiting, message)
            begins, self._is_handling = not self._is_handling, True
        if begins:
            self._loop.call_soon_threadsafe(self._pass_on)

    def resized(self, event: Callable[[], events.Resize]) -> None:
        """Pass on a resize; `event` is called when the app handles it, so that it has the size of that time.

        May be called from a signal handler, which must not wait for a lock.
        """
        if not self._has_resized:
            self._has_resized = True
            self._loop.call_soon_threadsafe(self._put_resize, event)

    def _put_resize(self, event: Callable[[], events.Resize]) -> None:
        self._has_resized = False
        self.put(event())

    def _pass_on(self) -> None:
        with self._lock:
            batch = [*self._waiting]
            self._waiting.clear()
            self._is_handling = bool(batch)
        for each in batch:
            self._app.post_message(each)
        if batch:
            self._call_after_app(lambda: self._call_after_screen(lambda: self._call_after_app(self._pass_on)))

    def _call_after_app(self, then: Callable[[], None]) -> None:
        """Call `then` once the app has handled its input."""
        if not self._app.call_later(then):
            self._loop.call_soon(then)

    def _call_after_screen(self, then: Callable[[], None]) -> None:
        # The app forwards mouse moves and resizes to the screen.
        screens = self._app.screen_stack
        if not (screens and screens[-1].is_running and screens[-1].call_later(then)):
            then()


def merge(waiting: deque[Message], message: Message) -> None:
    """Append a message, and remove those that it makes redundant."""
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
