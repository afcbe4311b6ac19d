"""The terminal's speed, and the only file that knows it.

A frame is followed by a question to the terminal (`CSI 6n`, where is the cursor). While two of these are unanswered no
further frame is composed, so that what changes meanwhile merges into one frame: a slow link shows fewer frames, not
late ones, and a stalled one never blocks the event loop. This hangs on private parts of Textual 8.2 and is left out for
other versions and for terminals that never answer.
"""

from __future__ import annotations

import time
from collections import deque
from importlib.metadata import version
from typing import Any

from textual.screen import Screen

QUESTION = "\x1b[6n"
IN_FLIGHT = 2
PATIENCE = 2.0
"""Seconds after which an answer is no longer waited for."""

RECENT = 5.0
"""Seconds for which merged frames count as news."""
NOTICEABLE = 10

SUPPORTED = version("textual").startswith("8.2.")


class AnswerGate:
    """Counts frames that the terminal has not answered."""

    def __init__(self) -> None:
        self._asked: list[float] = []
        self._answered_ever = False
        self._merged: deque[float] = deque(maxlen=100)

    def open(self) -> bool:
        """Whether a frame may be drawn now."""
        now = time.monotonic()
        self._asked = [each for each in self._asked if now - each < PATIENCE]
        return len(self._asked) < IN_FLIGHT

    def asked(self) -> None:
        """A frame and its question were written."""
        self._asked.append(time.monotonic())

    def answered(self) -> None:
        """The terminal has answered."""
        self._answered_ever = True
        if self._asked:
            self._asked.pop(0)

    def merged(self) -> None:
        """A frame was merged into a later one."""
        self._merged.append(time.monotonic())

    @property
    def held_back(self) -> int:
        """Frames merged in the last seconds, at most 100; 0 while there are so few that nobody would notice."""
        since = time.monotonic() - RECENT
        count = sum(each >= since for each in self._merged)
        return count if count >= NOTICEABLE else 0

    @property
    def useless(self) -> bool:
        """Whether the terminal was asked and has never answered in time."""
        now = time.monotonic()
        return not self._answered_ever and bool(self._asked) and now - self._asked[0] >= PATIENCE


class GatedScreen(Screen[None]):
    """A screen that composes a frame only while the gate is open."""

    def __init__(self, gate: AnswerGate) -> None:
        super().__init__()
        self._gate = gate
        self._asking = True

    def _compositor_refresh(self) -> None:
        super()._compositor_refresh()
        app: Any = self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        driver: Any = app._driver
        if self._asking and driver is not None and not app.is_headless and not app.is_inline and self.is_current:
            driver.write(QUESTION)
            self._gate.asked()

    def _on_timer_update(self) -> None:
        if self._asking and self._gate.useless:
            self._asking = False
        headless = self.app.is_headless  # pyright: ignore[reportUnknownMemberType]
        if self._asking and not headless and not self._gate.open():
            # The timer goes on ticking, so the dirty widgets are drawn as soon as the terminal has answered.
            self._gate.merged()
            return
        super()._on_timer_update()
