"""The log pane under a flood: it shows the newest lines, counts all lines, and shows none twice."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import LogViews
from bot_console.tui.console.model import LogFilter, Severity
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.logs.rows import LogRows
from fakes.console import START, FakeConsole
from piloting import Session, run
from samples import live

AT_ONCE = 5_000
SITE = ("node.py", "callback", 7)


class FloodedConsole(FakeConsole):
    """A console with a real log, searched in the background like that of a robot."""

    def __init__(self, lines: int) -> None:
        super().__init__(live()[0].current)
        self.records = LogStore(2 * lines)
        self.views = LogViews(self.records)
        self.logs.record = self.records.record

    def view_logs(self, which: LogFilter, instead_of: Any = None) -> Any:
        return self.views.open(which, instead_of)

    def flood(self, first: int) -> None:
        """Log many lines at once, numbered from `first`; each tenth is a warning."""
        for number in range(first, first + AT_ONCE):
            severity = Severity.WARN if number % 10 == 0 else Severity.INFO
            self.records.add(START, severity, "talker", f"line {number}", SITE)
            if number % AT_ONCE == AT_ONCE // 2:
                self.change(logs=self.records.state)  # the newer half arrives while this one is drawn


async def counts_until(session: Session, until: str) -> list[tuple[int, int]]:
    """Refresh until a line is shown; return the counts that were on the screen meanwhile."""
    counts: list[tuple[int, int]] = []
    while until not in session.text():
        session.app._heartbeat()
        await session.pilot.pause()
        found = re.search(r"(\d+) of (\d+)", session.text())
        assert found, session.text()
        counts.append((int(found[1]), int(found[2])))
    return counts


def shown_numbers(session: Session) -> np.ndarray[Any, Any]:
    numbers: Any = session.pane(LogsPane).query_one(LogRows).numbers
    return numbers.array()


@pytest.mark.parametrize("lines", [10_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_many_lines_are_followed_and_counted_exactly_once(lines: int) -> None:
    console = FloodedConsole(lines)

    async def play(session: Session) -> None:
        await session.press("2", "r")  # each line separately
        for first in range(0, lines, AT_ONCE):
            console.flood(first)
            counts = await counts_until(session, f"line {first + AT_ONCE - 1} ")
            assert counts and all(part <= whole for part, whole in counts)
        assert np.array_equal(shown_numbers(session), np.arange(lines)), "every line appears exactly once"
        console.change(logs=console.records.state)
        await counts_until(session, f"{lines} of {lines}")
        await session.press("w")
        await counts_until(session, f"{lines // 10} of {lines} · >= WARN")
        assert np.array_equal(shown_numbers(session), np.arange(0, lines, 10))
        console.flood(lines)
        counts = await counts_until(session, f"line {lines + AT_ONCE - 10} ")
        assert all(part <= whole for part, whole in counts)

    try:
        run((console, live()[1]), play)
    finally:
        console.views.close()
