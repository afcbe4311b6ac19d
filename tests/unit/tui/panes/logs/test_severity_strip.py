"""The bars of warnings and errors over time."""

from __future__ import annotations

from bot_console.tui.console.model import Severity
from bot_console.tui.panes.logs.severity_strip import BAR_S, MAX_BARS, SeverityStrip

WIDTH = 18


def rows(strip: SeverityStrip, now: float) -> list[str]:
    return ["".join(text for text, _ in line) for line in strip.lines(now, WIDTH)]


def test_each_row_has_a_bar_for_each_span_and_the_whole_number() -> None:
    strip = SeverityStrip()
    strip.take({Severity.INFO: 5}, 0.0)
    assert rows(strip, 0.0) == []
    strip.take({Severity.INFO: 9, Severity.WARN: 1}, 0.0)
    strip.take({Severity.INFO: 9, Severity.WARN: 3, Severity.ERROR: 1, Severity.FATAL: 1}, 2 * BAR_S)
    assert rows(strip, 3 * BAR_S) == [" E ▁▁▁▁▁▁█▁     2", " W ▁▁▁▁▅▁█▁     3"]


def test_bars_move_on_with_time_and_leave_the_number() -> None:
    strip = SeverityStrip()
    strip.take({Severity.WARN: 1}, 0.0)
    assert rows(strip, 7 * BAR_S) == [" W █▁▁▁▁▁▁▁     1"]
    assert rows(strip, 8 * BAR_S) == [" W ▁▁▁▁▁▁▁▁     1"]


def test_cleared_log_is_counted_from_zero() -> None:
    strip = SeverityStrip()
    strip.take({Severity.WARN: 7}, 0.0)
    strip.take({Severity.WARN: 2}, BAR_S)
    assert rows(strip, BAR_S) == [" W ▁▁▁▁▁▁▁█     2"]
    strip.take({}, BAR_S)
    assert rows(strip, BAR_S) == []


def test_only_a_visible_difference_is_a_change() -> None:
    strip = SeverityStrip()
    strip.take({Severity.WARN: 1}, 0.0)
    assert not strip.is_changed(0.0, WIDTH, is_shown=False)
    assert strip.is_changed(0.0, WIDTH, is_shown=True)
    assert not strip.is_changed(BAR_S / 2, WIDTH, is_shown=True)
    assert strip.is_changed(BAR_S, WIDTH, is_shown=True) and strip.is_changed(BAR_S, 9, is_shown=True)
    strip.take({Severity.WARN: 2}, BAR_S)
    assert strip.is_changed(BAR_S, 9, is_shown=True)


def test_old_spans_are_dropped() -> None:
    strip = SeverityStrip()
    for at in range(2 * MAX_BARS):
        strip.take({Severity.WARN: at + 1}, at * BAR_S)
    assert len(strip._spans[Severity.WARN]) == MAX_BARS
