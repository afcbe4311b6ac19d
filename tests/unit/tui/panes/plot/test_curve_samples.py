"""The samples that a curve keeps."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from bot_console.tui.console.plot.port import Samples
from bot_console.tui.console.protocol import Console
from bot_console.tui.panes.plot.curves import MAX_SAMPLES, Curve


class Source:
    """Gives a number of new samples at each poll; a sample's value is its number, its header time half a second
    earlier."""

    def __init__(self, each_time: int, *, headers: bool = True) -> None:
        self.each_time = each_time
        self.headers = headers

    def samples(self, path: str, after: int = 0) -> Samples:
        values = np.arange(after, after + self.each_time, dtype=float)
        given = values - 0.5 if self.headers else ()
        return cast(Any, Samples)(values / 10, values, after + self.each_time, headers=given)


def take(curve: Curve, source: Source, times: int) -> None:
    for _ in range(times):
        assert curve.fetch_samples(cast(Console, source))


def test_newest_samples_are_kept_after_a_burst() -> None:
    for each_time in (1, 7, 900, MAX_SAMPLES - 1, MAX_SAMPLES + 3):
        curve, polls = Curve("/t/data"), min(300, 3 * MAX_SAMPLES // each_time + 3)
        take(curve, Source(each_time), polls)
        end = polls * each_time
        expected = np.arange(max(0, end - MAX_SAMPLES), end)
        assert np.array_equal(curve.values, expected) and np.array_equal(curve.headers, expected - 0.5)
        assert np.array_equal(curve.times, expected / 10)


def test_returned_arrays_do_not_change_later() -> None:
    curve, held = Curve("/t/data"), []
    for _ in range(40):
        take(curve, Source(1100, headers=False), 1)
        held.append((curve.times, curve.values, curve.values.copy()))
    assert all(np.array_equal(values, copy) and np.array_equal(times, copy / 10) for times, values, copy in held)
    assert np.isnan(curve.headers).all()


def test_new_samples_share_memory_with_earlier_ones() -> None:
    curve = Curve("/t/data")
    take(curve, Source(20), 1)
    first = curve.values
    take(curve, Source(20), 500)
    assert np.shares_memory(first, curve.values), "arrays that are made again for each sample fragment the memory"


def test_only_new_samples_remain_after_clearing() -> None:
    curve = Curve("/t/data")
    take(curve, Source(20), 3)
    curve.clear()
    assert len(curve.times) == len(curve.headers) == 0
    take(curve, Source(20), 1)
    assert curve.values.tolist() == [*range(60, 80)]
