"""Handles keys in the order in which they were typed: each one waits for all effects of the one before.

Textual passes a key to the widget that has the focus at that moment, and a widget that a key opens gets the focus a
little later. Without this queue, characters typed fast, or on a busy machine, would act as commands instead of text.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from itertools import islice
from typing import TypeAlias

from bot_console.tui.keymap import is_stop_key
from bot_console.tui.keys.escape_parser import split_alt_key
from textual import events
from textual.app import App
from textual.dom import DOMNode

KEY_TIMEOUT_S = 1.0
"""Seconds after which an unfinished key, for instance one whose widget was removed, no longer holds up others."""

MAX_PASTE_CHARACTERS = 20_000
"""Maximum number of characters pasted at once.

Each change of a line is checked and completed as a whole: a million characters would keep the screen, and keys typed to
stop the robot, waiting for a minute.
"""

MAX_REPEATS = 8
"""Maximum number of waiting presses of the same key. A held key repeats at 25 Hz or more: a slower console would
continue for seconds after its release.
"""

MAX_WAITING_KEYS = 2_000
"""Maximum number of waiting keys of any kind; nobody types that many without seeing an effect."""

BUBBLING_PASSES = 2
"""A key bubbles from the focused widget up to the app, where its binding acts; then what the action sent must be
handled.
"""

KeyInput: TypeAlias = "events.Key | events.Paste"


class Keyboard:
    """Passes keys on one at a time.

    If keys are typed faster than they are handled, repeats of one key are dropped, except in a text field, and never a
    stop.
    """

    def __init__(
        self, app: App[None], deliver: Callable[[KeyInput], Awaitable[None]], typing: Callable[[], bool]
    ) -> None:
        """`typing` returns whether a text field has the focus."""
        self._app = app
        self._deliver = deliver
        self._typing = typing
        self._waiting: deque[KeyInput] = deque()
        self._current = 0
        """The number of the key being handled; 0 if none is."""
        self._count = 0
        self.may_handle: Callable[[KeyInput], bool] = lambda _: True
        """Whether a key may be handled yet; a key that may not also holds up those behind it."""
        self._overtaken = 0.0
        """When the last key that overtook others was typed, by the clock of Textual's events."""

    @property
    def is_idle(self) -> bool:
        """Whether all keys have been handled, with their effects."""
        return not (self._current or self._waiting)

    @property
    def is_busy(self) -> bool:
        """Whether the effects of a key are still in progress."""
        return bool(self._current)

    @property
    def next(self) -> KeyInput | None:
        """The key to be handled next, if keys are being held."""
        return self._waiting[0] if self._waiting else None

    def overtake(self, event: events.Key) -> None:
        """Note that a key is handled before those typed earlier."""
        self._overtaken = event.time

    def was_overtaken(self, event: events.Key) -> bool:
        """Whether a key was typed before one that has overtaken it."""
        return event.time < self._overtaken

    async def typed(self, event: KeyInput) -> None:
        """Handle a key now, or after those typed before it."""
        if self._exceeds_limit(event):
            return
        self._waiting.append(event)
        if not self._current:
            await self._next()
        elif len(self._waiting) == 1:
            self._wait_for_key()

    def _exceeds_limit(self, event: KeyInput) -> bool:
        if len(self._waiting) < MAX_REPEATS or (isinstance(event, events.Key) and is_stop_key(event.key)):
            return False
        if len(self._waiting) >= MAX_WAITING_KEYS:
            return True
        last = islice(reversed(self._waiting), MAX_REPEATS)
        return not self._typing() and all(_is_same_key(each, event) for each in last)

    async def _next(self) -> None:
        while self._waiting and not self._current and self.may_handle(self._first()):
            event = self._waiting.popleft()
            self._count += 1
            self._current = number = self._count
            target = self._app.focused or self._app.screen
            await self._deliver(event)
            self._follow(number, [*target.ancestors_with_self] * BUBBLING_PASSES)
            if self._waiting:
                self._wait_for_key()

    def _first(self) -> KeyInput:
        """The next key to handle; a key with Alt is split into two if the focused screen has no binding for it."""
        event = self._waiting[0]
        if isinstance(event, events.Key) and (both := split_alt_key(event, self._app.screen)):
            self._waiting.popleft()
            self._waiting.extendleft(reversed(both))
        return self._waiting[0]

    async def hold(self, may_handle: Callable[[KeyInput], bool]) -> None:
        """From now on, handle the first waiting key only if `may_handle` allows it."""
        self.may_handle = may_handle
        await self._next()

    async def detach(self) -> None:
        """Stop holding keys back, and handle those that wait."""
        await self.hold(lambda _: True)

    def release(self) -> None:
        """Continue with the next key, since the widget that received the last one has ended."""
        self._app.call_later(self._done, self._current)

    def _wait_for_key(self) -> None:
        self._app.set_timer(KEY_TIMEOUT_S, partial(self._done, self._current))

    def _follow(self, number: int, path: Sequence[DOMNode]) -> None:
        """Wait until each widget on the path has handled what it has received so far."""
        for at, node in enumerate(path):
            if node.is_running and node.call_later(self._follow, number, path[at + 1 :]):
                return
        screen = self._app.screen if self._app.screen_stack else None
        if screen is not None and not screen.is_mounted and screen.is_attached:
            screen.call_later(self._follow, number, ())
        else:
            self._app.call_later(self._done, number)

    async def _done(self, number: int) -> None:
        if number == self._current:
            self._current = 0
            await self._next()


def _is_same_key(one: KeyInput, other: KeyInput) -> bool:
    return isinstance(one, events.Key) and isinstance(other, events.Key) and one.key == other.key
