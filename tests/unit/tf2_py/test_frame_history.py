"""What is kept of one frame: for how long, in which order, and what waits unread."""

from __future__ import annotations

import pytest
from tf2_py.frame_history import DIGEST_AFTER, Entry, FrameHistory, Unread

KEEP = 1000
"""Times are whole numbers here, of no unit."""


def entry(time: int, parent: str = "map") -> Entry:
    return time, parent, (float(time), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), "me"


def history(*entries: Entry, is_static: bool = False) -> FrameHistory:
    found = FrameHistory(KEEP, is_static, lambda unread: found.insert(entry(unread[0])) and None)
    for each in entries:
        assert found.insert(each) is None
    return found


def unread(time: int) -> Unread:
    return time, "map", float(time), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0


def x_at(found: FrameHistory, time: int) -> float:
    return found.at(time)[1][0]


def test_what_comes_late_has_its_place() -> None:
    found = history(entry(100), entry(300), entry(200))
    assert [x_at(found, time) for time in (100, 150, 200, 300, 0)] == [100.0, 150.0, 200.0, 300.0, 300.0]
    for again in (200, 300):
        assert found.insert(entry(again)) == "TF_REPEATED_DATA ignoring data with redundant timestamp"
    assert found.latest() == (300, "map")


@pytest.mark.parametrize(("time", "refused"), [(1000, False), (999, True)])
def test_what_is_older_than_is_kept_is_refused(time: int, refused: bool) -> None:
    found = history(entry(2000))
    assert (found.insert(entry(time)) == "TF_OLD_DATA ignoring data from the past") is refused


@pytest.mark.parametrize(
    ("time", "words"),
    [
        (2001, "into the future.  Requested time 0.000002 but the latest data is at time 0.000002"),
        (999, "into the past.  Requested time 0.000001 but the earliest data is at time 0.000001"),
    ],
)
def test_beyond_what_is_kept_there_is_nothing(time: int, words: str) -> None:
    found = history(entry(900), entry(1000), entry(2000))
    assert x_at(found, 1000) == 1000.0 and x_at(found, 1001) == 1001.0
    with pytest.raises(LookupError, match=words):
        found.at(time)


def test_a_frame_that_changes_its_parent_stays_where_it_was_until_then() -> None:
    found = history(entry(100), entry(200, "odom"), entry(300, "odom"))
    assert [found.at(time)[0] for time in (100, 199, 200, 300)] == ["map", "map", "odom", "odom"]
    assert x_at(found, 199) == 100.0


def test_a_fixed_frame_is_where_it_was_reported_last_at_any_time() -> None:
    found = history(entry(500), entry(100), is_static=True)
    assert (x_at(found, 7), x_at(found, 10**9), found.latest()) == (100.0, 100.0, (0, "map"))


def test_the_old_is_let_go() -> None:
    found = history()
    for time in range(0, 20 * KEEP, 10):
        found.insert(entry(time))
    assert len(found.entries) <= 2 * KEEP // 10 + 2
    assert found.entries[found.first] == entry(19 * KEEP - 10)
    assert x_at(found, 19 * KEEP - 10) == 19 * KEEP - 10


@pytest.mark.parametrize("question", ["at", "latest"])
def test_what_waits_is_read_when_somebody_asks(question: str) -> None:
    found = history(entry(100))
    found.waiting += [unread(200), unread(300)]
    assert x_at(found, 250) == 250.0 if question == "at" else found.latest() == (300, "map")
    assert found.waiting == []


def test_what_waits_too_long_is_let_go_unread() -> None:
    found = history(entry(1))
    found.waiting += [unread(time) for time in range(0, DIGEST_AFTER * 10, 10)]
    found.drop_old()
    newest = (DIGEST_AFTER - 1) * 10
    assert [each[0] for each in found.waiting] == list(range(newest - KEEP, newest + 1, 10))


def test_nothing_young_goes_where_what_waits_is_out_of_order() -> None:
    found = history(entry(1))
    found.waiting += [unread(time) for time in (10, 5000, 20, 30, 5010)]
    found.drop_old()
    assert unread(5000) in found.waiting
