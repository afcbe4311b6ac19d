"""The buffer against a naive model: all transforms in a list, and 4x4 matrices."""

from __future__ import annotations

import math

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from hypothesis import given
from hypothesis import strategies as st
from rclpy.time import Time
from tf2_py import BufferCore, TransformException
from tf_transformations import quaternion_matrix, quaternion_slerp

FRAMES = ["root", "a", "b", "c", "d", "e"]
PARENTS = {"a": "root", "b": "a", "c": "a", "d": "c", "e": "root"}
Entry = tuple[str, int, list[float], list[float]]

moves = st.lists(st.floats(-10, 10), min_size=3, max_size=3)
numbers = st.floats(-1, 1)
any_turns = st.lists(numbers, min_size=4, max_size=4)
turns_about_an_axis = st.tuples(st.sampled_from((0, 1, 2, 2, 2)), numbers, numbers).map(
    lambda each: [each[1] if axis == each[0] else 0.0 for axis in range(3)] + [each[2]]
)
turns = st.one_of(any_turns, turns_about_an_axis).filter(lambda each: math.hypot(*each) > 0.1)


def transforms_until(latest: int) -> st.SearchStrategy[list[Entry]]:
    """Transforms of the first seconds, enough that most lookups succeed."""
    each = st.tuples(st.sampled_from(FRAMES[1:]), st.integers(1, latest), moves, turns)
    return st.lists(each, min_size=20, max_size=40)


entries = st.sampled_from([3, 3, 20]).flatmap(transforms_until)
quarters = st.one_of(st.integers(4, 12), st.integers(1, 80))


def unit(turn: list[float]) -> np.ndarray:
    return np.array(turn) / np.linalg.norm(turn)


def filled_buffer(known: list[Entry]) -> BufferCore:
    """A buffer with all transforms, added in the given order; half of them are kept unparsed."""
    buffer = BufferCore()
    for index, (child, second, move, turn) in enumerate(known):
        message = TransformStamped()
        message.header.frame_id, message.child_frame_id = PARENTS[child], child
        message.header.stamp.sec = second
        t, r = message.transform.translation, message.transform.rotation
        t.x, t.y, t.z = move
        r.x, r.y, r.z, r.w = unit(turn).tolist()
        if index % 2:
            buffer.set_transform(message, "test")
        else:
            buffer._take_later([message])
    return buffer


def matrix_in_parent(known: list[Entry], child: str, time: float) -> np.ndarray | None:
    """The matrix of a frame in its parent at a time (s); None if it is unknown.

    Of several different transforms with the same time the last one counts, but at the oldest time and at the end of an
    interpolation the first one does.
    """
    kept: dict[int, list[tuple[np.ndarray, np.ndarray]]] = {}
    for name, second, move, turn in known:
        if name != child or (kept and second < max(kept) - 10):
            continue
        same_time = kept.setdefault(second, [])
        if not any(np.array_equal(move, each) and np.array_equal(unit(turn), other) for each, other in same_time):
            same_time.append((np.array(move), unit(turn)))
    times = sorted(each for each in kept if each >= max(kept) - 10)
    if not times or not times[0] <= time <= times[-1]:
        return None
    before = max(each for each in times if each <= time)
    after = min(each for each in times if each >= time)
    move0, turn0 = kept[before][0 if time == times[0] != times[-1] else -1]
    move1, turn1 = kept[after][0]
    if before == after:
        matrix = quaternion_matrix(turn0)
        matrix[:3, 3] = move0
        return matrix
    share = (time - before) / (after - before)
    matrix = quaternion_matrix(quaternion_slerp(turn0, turn1, share))
    matrix[:3, 3] = move0 + share * (move1 - move0)
    return matrix


def naive(known: list[Entry], target: str, source: str, time: float) -> np.ndarray | None:
    up = {each: _to_common(known, each, _common(target, source), time) for each in (target, source)}
    to, of = up[target], up[source]
    return None if to is None or of is None else np.linalg.inv(to) @ of


def _chain(frame: str) -> list[str]:
    return [frame, *_chain(PARENTS[frame])] if frame in PARENTS else [frame]


def _common(one: str, other: str) -> str:
    return next(each for each in _chain(one) if each in _chain(other))


def _to_common(known: list[Entry], frame: str, common: str, time: float) -> np.ndarray | None:
    matrix = np.identity(4)
    while frame != common:
        step = matrix_in_parent(known, frame, time)
        if step is None:
            return None
        matrix, frame = step @ matrix, PARENTS[frame]
    return matrix


@pytest.mark.slow
@given(entries, st.sampled_from(FRAMES), st.sampled_from(FRAMES), quarters)
def test_a_transform_is_the_product_of_matrices(known: list[Entry], target: str, source: str, quarter: int) -> None:
    time = quarter / 4
    buffer = filled_buffer(known)
    expected = naive(known, target, source, time)
    stamp = Time(nanoseconds=quarter * 250_000_000)
    there = all(buffer._frameExists(each) for each in (target, source))
    if target == source and not there:
        return
    if expected is None or not there:
        with pytest.raises(TransformException):
            buffer.lookup_transform_core(target, source, stamp)
        return
    found = buffer.lookup_transform_core(target, source, stamp).transform
    matrix = quaternion_matrix([found.rotation.x, found.rotation.y, found.rotation.z, found.rotation.w])
    matrix[:3, 3] = found.translation.x, found.translation.y, found.translation.z
    np.testing.assert_allclose(matrix, expected, atol=1e-6)
