"""The path between two frames: the newest time at which it is known, and trees without such a path."""

from __future__ import annotations

import pytest
from frames import frame, place
from rclpy.time import Time
from tf2_py import BufferCore, ConnectivityException, LookupException

NEWEST = {"a": 5.0, "under a": 4.0, "b": 3.0, "under b": 6.0}
PARENTS = {"a": "root", "under a": "a", "b": "root", "under b": "b", "laser": "under b", "lens": "laser"}


@pytest.fixture
def buffer() -> BufferCore:
    found = BufferCore()
    for child, parent in PARENTS.items():
        if child not in NEWEST:
            found.set_transform_static(frame(parent, child, x=1.0), "me")
            continue
        for second in (1.0, NEWEST[child]):
            found.set_transform(frame(parent, child, second, x=second), "me")
    return found


@pytest.mark.parametrize(
    ("one", "other", "seconds"),
    [
        ("root", "a", 5.0),
        ("a", "under a", 4.0),
        ("root", "under a", 4.0),
        ("root", "under b", 3.0),
        ("a", "b", 3.0),
        ("under a", "under b", 3.0),
        ("under a", "lens", 3.0),
        ("b", "lens", 6.0),
        ("under b", "lens", 0.0),
    ],
)
def test_lookup_at_time_zero_uses_the_newest_common_time(
    buffer: BufferCore, one: str, other: str, seconds: float
) -> None:
    expected = Time(nanoseconds=round(seconds * 1e9))
    assert buffer.get_latest_common_time(one, other) == buffer.get_latest_common_time(other, one) == expected
    stamp = buffer.lookup_transform_core(one, other, Time()).header.stamp
    assert (stamp.sec, stamp.nanosec) == (seconds, 0)


def test_lookup_goes_up_and_down_the_tree(buffer: BufferCore) -> None:
    found = buffer.lookup_transform_core("under a", "lens", Time(seconds=3))
    ways = {"a": 3.0, "under a": 3.0, "b": 3.0, "under b": 3.0}  # the distance of each from its parent equals its time
    assert place(found)[0] == pytest.approx(ways["b"] + ways["under b"] + 2.0 - ways["a"] - ways["under a"])


@pytest.mark.parametrize("time", [Time(), Time(seconds=2)])
def test_frames_of_two_trees_are_not_connected(buffer: BufferCore, time: Time) -> None:
    buffer.set_transform_static(frame("island", "palm"), "me")
    for question in (("a", "palm"), ("palm", "a"), ("root", "island"), ("island", "lens")):
        with pytest.raises(ConnectivityException, match="not part of the same tree"):
            buffer.lookup_transform_core(*question, time)


@pytest.mark.parametrize("time", [Time(), Time(seconds=2)])
@pytest.mark.parametrize("question", [("root", "in a loop"), ("in a loop", "root"), ("in a loop", "lens")])
def test_loop_is_reported_from_both_sides(buffer: BufferCore, question: tuple[str, str], time: Time) -> None:
    buffer.set_transform_static(frame("back", "in a loop"), "me")
    buffer.set_transform_static(frame("in a loop", "back"), "me")
    with pytest.raises(LookupException, match="it contains a loop"):
        buffer.lookup_transform_core(*question, time)
