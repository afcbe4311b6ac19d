"""Moves from match to match in the log. The search runs in the background, so that even a million lines delay no
key.
"""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.console.logs.port import LogFindings, LogView
from bot_console.tui.console.model import LogFilter

OpenView = Callable[[LogFilter, "LogView | None"], LogView]


class MatchSearch:
    """Finds the next or previous line that passes a filter, wrapping around at the ends."""

    def __init__(self, open_view: OpenView) -> None:
        self._open_view = open_view
        self._which: LogFilter | None = None
        self._view: LogView | None = None
        self._wanted: tuple[int, int] | None = None
        self._at = -1

    @property
    def under_way(self) -> bool:
        """Whether a step is waiting for the result of the search."""
        return self._wanted is not None

    def seek(self, which: LogFilter, at: int, step: int) -> None:
        """Search for the next (`step` 1) or previous (-1) line that passes, starting at record number `at`."""
        if which != self._which or self._view is None:
            self._view = self._open_view(which, self._view)
            self._which = which
        self._wanted = (at, step)

    def poll(self) -> int | None:
        """The number of the line found; -1 if there is none, None while the search is running."""
        if self._wanted is None or self._view is None:
            return None
        found = self._view.poll()
        target = _target(found, *self._wanted)
        if target is not None:
            self._wanted = None
            self._at = target
        return target

    def forget(self) -> None:
        """Forget the search, since the log has been replaced."""
        self._which = self._view = self._wanted = None
        self._at = -1

    def text(self) -> str:
        """The position among the matches, such as "match 2 of 7"; empty before the first step."""
        if self._view is None or self._at < 0:
            return ""
        found = self._view.poll()
        more = "" if found.complete else "+"
        return f"match {found.numbers.place(self._at) + 1} of {len(found.numbers)}{more}"


def _target(found: LogFindings, at: int, step: int) -> int | None:
    numbers = found.numbers
    if step < 0:
        before = numbers.place(at) - 1
        if before >= 0:
            return numbers[before]
        if not found.complete:
            return None  # older lines are still being searched
        return numbers[len(numbers) - 1] if len(numbers) else -1
    if not found.complete and found.begin > at + 1:
        return None  # there may be matches nearer than those found
    behind = numbers.place(at + 1)
    if behind < len(numbers):
        return numbers[behind]
    if not found.complete:
        return None
    return numbers[0] if len(numbers) else -1
