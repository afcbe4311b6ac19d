"""Notices a stop key as soon as it is read, so that the robot does not wait until earlier input has been handled."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Set
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.keymap import is_stop_key
from bot_console.tui.keys.escape_parser import ALT
from textual import events

TURN_TIMEOUT_S = 0.1
"""Seconds that a stop key with no input before it may wait for its turn; the screen may be hanging."""


class Holder(Protocol):
    """Holds the robot for individual key presses; the methods may be called from any thread."""

    def hold_early(self, press: str) -> None:
        """Hold the robot for a key press that has not had its turn."""
        ...

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep that press's stop until it is released like any other, or withdraw only that stop."""
        ...


@dataclass(eq=False)
class Press:
    """A press of the stop key that has not had its turn."""

    id: str
    event: events.Key
    due: float
    """The time at which the robot is held for it, if it has not had its turn by then."""
    seen: Set[str]
    """The ids of this console's stops that the screen showed: those that the person may have meant to release."""
    is_held: bool = False


class EarlyStop:
    """Holds the robot for stop keys that have to wait, and decides what they mean when their turn comes.

    The thread that reads keys calls `typed` and `poll`, the app's thread calls `attach` and `has_acted`.
    """

    def __init__(
        self,
        idle: Callable[[], bool],
        typing: Callable[[], bool],
        shown: Callable[[], Set[str]],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`idle`: whether all earlier input is handled. `typing`: whether a text field has the focus. `shown`: the ids
        of this console's stops that the screen shows.
        """
        self._idle = idle
        self._typing = typing
        self._shown = shown
        self._clock = clock
        self._holder: Holder | None = None
        self._stop: Callable[[], None] = lambda: None
        self._own_stops: Callable[[], Set[str]] = frozenset
        self._presses: list[Press] = []
        self._count = 0
        self._lock = threading.Lock()

    def attach(self, holder: Holder, stop: Callable[[], None], own_stops: Callable[[], Set[str]]) -> None:
        """Act on a robot from now on, and for keys pressed before.

        `stop` is the action of the stop key; `own_stops` returns the ids of this console's present stops, which may be
        ahead of the screen.
        """
        with self._lock:
            self._holder, self._stop, self._own_stops = holder, stop, own_stops
            for each in self._presses:
                if each.is_held:
                    holder.hold_early(each.id)

    @property
    def due(self) -> float | None:
        """The time, by the clock, at which to call `poll`; None if that is not needed."""
        return min((each.due for each in [*self._presses] if not each.is_held), default=None)

    def is_stop(self, event: events.Key) -> bool:
        """Whether a key may stop the robot; with Alt it may be two keys, Esc and the stop key."""
        character = event.character if event.key.startswith(ALT) else None
        return is_stop_key(event.key) or (character is not None and is_stop_key(character))

    def typed(self, event: events.Key, *, alone: bool) -> None:
        """Take note of a stop key; `alone` says whether it was read with nothing before it."""
        with self._lock:
            is_next = alone and not self._presses and self._idle()
            self._count += 1
            seen = frozenset[str]() if self._presses else self._shown()
            press = Press(str(self._count), event, self._clock(), seen)
            self._presses.append(press)
            if is_next:
                press.due += TURN_TIMEOUT_S
            else:
                self._hold(press)

    def poll(self) -> None:
        """Hold the robot for keys that have waited too long."""
        now = self._clock()
        with self._lock:
            for each in self._presses:
                if not each.is_held and now >= each.due:
                    self._hold(each)

    def _hold(self, press: Press) -> None:
        press.is_held = True
        if self._holder is not None:
            try:
                self._holder.hold_early(press.id)
            except Exception:  # keys must still be read if the link to the robot fails
                press.is_held, press.due = False, math.inf

    def has_acted(self, event: events.Key) -> bool:
        """Whether the stop key already took effect before its turn; if not, it is handled like any other key.

        It releases only a stop that was on the screen when it was pressed. If that has been released since, the key
        stops the robot: the person may have seen it move before the screen said so.
        """
        with self._lock:
            press = next((each for each in self._presses if _is_event_of(event, each)), None)
            if press is None:
                return False
            self._presses.remove(press)
        is_text = not is_stop_key(event.key) or (event.is_printable and self._typing())
        releases = bool(press.seen & self._own_stops())
        if press.is_held and self._holder is not None:
            # Otherwise a key that is to release would only find its own stop, which is not acknowledged yet.
            self._holder.settle_early(press.id, keep=not (is_text or releases))
        if not (is_text or releases):
            self._stop()
        return not (is_text or releases)


def _is_event_of(event: events.Key, press: Press) -> bool:
    return event is press.event or (event.time == press.event.time and is_stop_key(event.key))
