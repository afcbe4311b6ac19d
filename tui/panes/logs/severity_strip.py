"""The strip above the log that shows when warnings and errors were logged: a bar for every few seconds. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from bot_console.tui.console.model import Severity
from bot_console.tui.format import SEVERITY_CHARACTERS
from bot_console.tui.text.bars import bars
from bot_console.tui.widgets.picture import Line

BAR_S = 5.0
"""Seconds that a bar represents."""
MAX_BARS = 400
FIGURE = 7
"""Cells of the number behind the bars."""
ROWS = ((Severity.ERROR, (Severity.ERROR, Severity.FATAL), "error"), (Severity.WARN, (Severity.WARN,), "warn"))
"""The rows of the strip: name, severities counted, style."""


class SeverityStrip:
    """Counts the lines of a severity that were logged in each span of time, by the clock of the caller."""

    def __init__(self) -> None:
        self._seen: Mapping[Severity, int] = {}
        self._spans: dict[Severity, Counter[int]] = {name: Counter() for name, _, _ in ROWS}
        self._drawn: tuple[object, ...] = ()

    def take(self, counts: Mapping[Severity, int], now: float) -> None:
        """Count the lines since the last call as logged at `now` (s); if there are fewer than before, start over."""
        before: Mapping[Severity, int] = self._seen
        if any(counts.get(each, 0) < count for each, count in before.items()):
            before = dict[Severity, int]()
            for spans in self._spans.values():
                spans.clear()
        self._seen = counts
        for spans, now_seen, seen in zip(self._spans.values(), _by_row(counts), _by_row(before), strict=True):
            if now_seen > seen:
                spans[int(now // BAR_S)] += now_seen - seen
            if len(spans) > MAX_BARS:
                del spans[min(spans)]

    def is_changed(self, now: float, width: int, is_shown: bool) -> bool:
        """Whether the strip has to be redrawn since the last call; never while it stays hidden."""
        drawn = (int(now // BAR_S), width, _by_row(self._seen)) if is_shown else ()
        before, self._drawn = self._drawn, drawn
        return drawn != before

    def lines(self, now: float, width: int) -> list[Line]:
        """A line for each severity that has been logged, the newest bar last."""
        last, count = int(now // BAR_S), max(0, width - FIGURE - 3)
        found: list[Line] = []
        for (name, _, style), total in zip(ROWS, _by_row(self._seen), strict=True):
            if total:
                drawn = "".join(bars([self._spans[name][at] for at in range(last - count + 1, last + 1)]))
                figure = f"{total:>{FIGURE - 1}}"
                found.append(((f" {SEVERITY_CHARACTERS[name]} ", style), (drawn, style), (figure, "")))
        return found


def _by_row(counts: Mapping[Severity, int]) -> list[int]:
    """The number of log lines that each row of the strip counts."""
    return [sum(counts.get(each, 0) for each in severities) for _, severities, _ in ROWS]
