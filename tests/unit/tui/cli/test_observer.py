"""The lateness of timers in the report of a headless run."""

from __future__ import annotations

import tracemalloc
from types import SimpleNamespace

from bot_console.tui.cli.headless.observer import PROBE_PERIOD_S, Observer

PERIOD = round(PROBE_PERIOD_S * 1e9)


def observer_with_lateness(late):
    """An observer whose timer was called late by these numbers of nanoseconds."""
    observer = Observer(1.0)
    moments = iter((number + 1) * PERIOD + each for number, each in enumerate(late))
    observer._steady = SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=next(moments)))
    observer._due = 0
    return observer


def test_lateness_of_a_timer_is_reported():
    observer = observer_with_lateness([0] * 98 + [1_234_567, 5_000_000])
    for _ in range(100):
        observer._probe()
    assert observer.report()["timer_lateness_ms"] == {"median": 0.0, "p99": 5.0, "max": 5.0}


def test_long_run_uses_no_more_memory_than_a_short_one():
    observer = observer_with_lateness([0] * 20_000)
    observer._probe()
    tracemalloc.start()
    try:
        for _ in range(19_999):
            observer._probe()
        assert tracemalloc.get_traced_memory()[0] < 10_000
    finally:
        tracemalloc.stop()
