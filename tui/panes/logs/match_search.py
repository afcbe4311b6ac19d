"""Going from match to match in the log, searched in the background: a million lines delay no key."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.console.log_protocol import LogFindings, LogView
from bot_console.tui.console.model import LogFilter

OpenView = Callable[[LogFilter, "LogView | None"], LogView]


class MatchSearch:
    """Goes to the next line that passes a filter, or the one before; around the end."""

    def __init__(self, open_view: OpenView) -> None:
        self._open_view = open_view
        self._which: LogFilter | None = None
        self._view: LogView | None = None
        self._wanted: tuple[int, int] | None = None
        self._at = -1

    @property
    def under_way(self) -> bool:
        """Whether a step waits for what the search will find."""
        return self._wanted is not None

    def seek(self, which: LogFilter, at: int, step: int) -> None:
        """Look for the next (`step` 1) line that passes, seen from the one numbered `at`, or the previous one (-1)."""
        if which != self._which or self._view is None:
            self._view = self._open_view(which, self._view)
            self._which = which
        self._wanted = (at, step)

    def poll(self) -> int | None:
        """The number of the line that was looked for; -1 where there is none, None while it is searched."""
        if self._wanted is None or self._view is None:
            return None
        found = self._view.poll()
        target = _target(found, *self._wanted)
        if target is not None:
            self._wanted = None
            self._at = target
        return target

    def forget(self) -> None:
        """The log is another one now."""
        self._which = self._view = self._wanted = None
        self._at = -1

    def text(self) -> str:
        """Which match of how many was gone to; empty before the first."""
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
            return None  # older ones are still looked at
        return numbers[len(numbers) - 1] if len(numbers) else -1
    if not found.complete and found.begin > at + 1:
        return None  # there may be nearer ones than those found
    behind = numbers.place(at + 1)
    if behind < len(numbers):
        return numbers[behind]
    if not found.complete:
        return None
    return numbers[0] if len(numbers) else -1
