"""Time spans in a filter: in local time, on any day, across midnight and across daylight-saving changes."""

from __future__ import annotations

import time
from collections.abc import Iterator
from functools import cache

import pytest
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.time_filter import SECOND_NS, parse_span
from bot_console.tui.console.model import LogFilter, Severity
from bot_console.tui.format import clock_text

NOW = 1_792_913_400 * SECOND_NS
"""2026-10-25 07:30:00 UTC: a day on which clocks in Berlin are put back."""
BERLIN = "CET-1CEST,M3.5.0,M10.5.0/3"
"""The time zone rule of Berlin: a small system has no time zone files, and takes a zone's name for UTC."""


@pytest.fixture(autouse=True)
def berlin(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    with monkeypatch.context() as patch:
        patch.setenv("TZ", BERLIN)
        time.tzset()
        yield
    time.tzset()


CLOCK = {
    "14:03": lambda at: at[:5] == "14:03",
    "02:30": lambda at: at[:5] == "02:30",
    ">=23:59:30": lambda at: at >= "23:59:30",
    "<0:01": lambda at: at < "00:01",
    "<=00:01": lambda at: at < "00:02",
    ">14:03": lambda at: at >= "14:04",
    "23:59..00:00": lambda at: at >= "23:59" or at < "00:01",
    "02:59:59..03:00:30": lambda at: "02:59:59" <= at < "03:00:31",
    "14:03:00.250": lambda at: at == "14:03:00.250",
}


@cache
def two_days() -> tuple[list[int], list[str], LogStore]:
    """Lines 10 s apart: their stamps, the times of day shown, and a store that contains them."""
    stamps = [NOW + step * 10 * SECOND_NS + SECOND_NS // 4 for step in range(-8640, 8640)]
    store = LogStore(len(stamps) * 2)
    for each in stamps:
        store.add(each, Severity.INFO, "n", "x")
    return stamps, [clock_text(each) for each in stamps], store


@pytest.mark.parametrize("written", CLOCK)
def test_a_time_of_day_matches_the_time_shown(written: str) -> None:
    stamps, shown, store = two_days()
    wanted = [number for number, each in enumerate(shown) if CLOCK[written](each)]
    assert matching(store, LogFilter(words=f"time:{written}")) == wanted and wanted
    span = parse_span(written, NOW)
    assert [number for number, each in enumerate(stamps) if span.holds(each)] == wanted


@pytest.mark.parametrize(
    ("written", "begin", "end"),
    [
        ("-5m", NOW - 300 * SECOND_NS, None),
        ("-2h..-30min", NOW - 7200 * SECOND_NS, NOW - 1800 * SECOND_NS),
        ("@12.5", 12_500_000_000, 12_600_000_000),
        ("@12..@14", 12 * SECOND_NS, 15 * SECOND_NS),
        ("<@12", 0, 12 * SECOND_NS),
        ("2026-10-25", 1_792_879_200 * SECOND_NS, 1_792_969_200 * SECOND_NS),
        ("2026-10-25T08:30..", NOW, None),
        ("=2026-10-25T08:30:00", NOW, NOW + SECOND_NS),
    ],
)
def test_times_with_a_date_select_that_day(written: str, begin: int, end: int | None) -> None:
    span = parse_span(written, NOW)
    assert not span.daily and span.begin == begin
    assert span.holds(begin) and not span.holds(begin - 1)
    assert span.holds(end - 1) and not span.holds(end) if end is not None else span.holds(begin + 10**18)


@pytest.mark.parametrize(
    "written",
    ["", "..", "24:00", "12:60", "1:2", "14:03.5", "2026-02-30", "2026-10-25T", "-5", "@", "14:00..@3", "x..y"],
)
def test_an_invalid_time_is_explained(written: str) -> None:
    with pytest.raises(ValueError, match=r"time '.*for instance 14:03"):
        parse_span(written, NOW)
