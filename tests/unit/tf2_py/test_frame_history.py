"""The history of one frame: how long it is kept, in which order, and which entries are still unread."""

from __future__ import annotations

import pytest
from tf2_py.frame_history import DIGEST_AFTER, Entry, FrameHistory, Unread

KEEP = 1000
"""Times are integers here, without a unit."""


def entry(time: int, parent: str = "map") -> Entry:
    return time, parent, (float(time), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), "me"


def history(*entries: Entry, is_static: bool = False) -> FrameHistory:
    found = FrameHistory(KEEP, is_static, lambda unread: found.insert(entry(unread[0])) and None)
    for each in entries:
        assert found.insert(each)
    return found


def unread_entry(time: int) -> Unread:
    return time, "map", float(time), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0


def x_at(found: FrameHistory, time: int) -> float:
    return found.at(time)[1][0]


def test_late_entries_are_sorted_in() -> None:
    found = history(entry(100), entry(300), entry(200))
    assert [x_at(found, time) for time in (100, 150, 200, 300, 0)] == [100.0, 150.0, 200.0, 300.0, 300.0]
    assert found.latest() == (300, "map")


@pytest.mark.parametrize(
    ("time", "parent", "newest"), [(100, "map", "map"), (200, "odom", "map"), (300, "odom", "odom")]
)
def test_last_entry_with_one_time_counts_except_at_the_oldest_time(time: int, parent: str, newest: str) -> None:
    found = history(entry(100), entry(200), entry(300), entry(time))
    assert len(found.entries) == 3
    assert found.insert((time, "odom", (7.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), "you"))
    assert found.at(time) == (parent, (7.0 if parent == "odom" else float(time), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0))
    assert found.latest() == (300, newest)


@pytest.mark.parametrize(("time", "refused"), [(1000, False), (999, True)])
def test_entries_older_than_the_history_are_refused(time: int, refused: bool) -> None:
    found = history(entry(2000))
    assert found.insert(entry(time)) is not refused


@pytest.mark.parametrize(
    ("time", "words"),
    [
        (2001, "into the future.  Requested time 0.000002 but the latest data is at time 0.000002"),
        (999, "into the past.  Requested time 0.000001 but the earliest data is at time 0.000001"),
    ],
)
def test_times_outside_the_history_raise_lookup_error(time: int, words: str) -> None:
    found = history(entry(900), entry(1000), entry(2000))
    assert x_at(found, 1000) == 1000.0 and x_at(found, 1001) == 1001.0
    with pytest.raises(LookupError, match=words):
        found.at(time)


def test_changed_parent_takes_effect_at_its_time() -> None:
    found = history(entry(100), entry(200, "odom"), entry(300, "odom"))
    assert [found.at(time)[0] for time in (100, 199, 200, 300)] == ["map", "map", "odom", "odom"]
    assert x_at(found, 199) == 100.0


def test_static_frame_has_its_last_transform_at_any_time() -> None:
    found = history(entry(500), entry(100), is_static=True)
    assert (x_at(found, 7), x_at(found, 10**9), found.latest()) == (100.0, 100.0, (0, "map"))


def test_old_entries_are_dropped() -> None:
    found = history()
    for time in range(0, 20 * KEEP, 10):
        found.insert(entry(time))
    assert len(found.entries) <= 2 * KEEP // 10 + 2
    assert found.entries[found.first] == entry(19 * KEEP - 10)
    assert x_at(found, 19 * KEEP - 10) == 19 * KEEP - 10


@pytest.mark.parametrize("question", ["at", "latest"])
def test_unread_entries_are_read_on_demand(question: str) -> None:
    found = history(entry(100))
    found.waiting += [unread_entry(200), unread_entry(300)]
    assert x_at(found, 250) == 250.0 if question == "at" else found.latest() == (300, "map")
    assert found.waiting == []


def test_old_unread_entries_are_dropped() -> None:
    found = history(entry(1))
    found.waiting += [unread_entry(time) for time in range(0, DIGEST_AFTER * 10, 10)]
    found.drop_old()
    newest = (DIGEST_AFTER - 1) * 10
    assert [each[0] for each in found.waiting] == list(range(newest - KEEP, newest + 1, 10))


def test_recent_entries_are_kept_if_unread_ones_are_out_of_order() -> None:
    found = history(entry(1))
    found.waiting += [unread_entry(time) for time in (10, 5000, 20, 30, 5010)]
    found.drop_old()
    assert unread_entry(5000) in found.waiting
