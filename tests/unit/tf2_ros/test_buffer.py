"""The buffer: its answers and its error messages. Contract: upstream's tf2."""

from __future__ import annotations

import math
from typing import Any

import pytest
from frames import frame, place
from geometry_msgs.msg import PointStamped, PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_py.frame_history import DIGEST_AFTER
from tf2_ros import (
    Buffer,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TypeException,
)


def at(seconds: float) -> Time:
    return Time(nanoseconds=round(seconds * 1e9))


@pytest.fixture
def buffer() -> Buffer:
    found = Buffer()
    for second, x in ((1.0, 0.0), (2.0, 1.0), (3.0, 3.0)):
        found.set_transform(frame("map", "odom", second, x), "me")
    found.set_transform(frame("odom", "base", 1.5, 1.0, yaw=0.0), "me")
    found.set_transform(frame("odom", "base", 2.5, 1.0, yaw=math.pi / 2), "me")
    found.set_transform_static(frame("base", "laser", x=0.5), "me")
    found.set_transform_static(frame("island", "palm"), "me")
    return found


@pytest.mark.parametrize(
    ("target", "source", "seconds", "expected"),
    [
        ("map", "odom", 2.5, (2.0, 0.0, 0.0)),
        ("odom", "map", 2.5, (-2.0, 0.0, 0.0)),
        ("odom", "base", 2.0, (1.0, 0.0, math.pi / 4)),
        ("map", "laser", 2.5, (3.0, 0.5, math.pi / 2)),
        ("laser", "map", 2.5, (-0.5, 3.0, -math.pi / 2)),
        ("map", "laser", 0.0, (3.0, 0.5, math.pi / 2)),
        ("laser", "base", 99.0, (-0.5, 0.0, 0.0)),
        ("base", "base", 7.0, (0.0, 0.0, 0.0)),
    ],
)
def test_lookup_interpolates_between_transforms(
    buffer: Buffer, target: str, source: str, seconds: float, expected: tuple[float, ...]
) -> None:
    found = buffer.lookup_transform(target, source, at(seconds))
    assert place(found) == pytest.approx(expected, abs=1e-8)
    assert (found.header.frame_id, found.child_frame_id) == (target, source)
    turn = found.transform.rotation
    assert turn.x**2 + turn.y**2 + turn.z**2 + turn.w**2 == pytest.approx(1.0)


def test_time_zero_means_newest_time_common_to_all_frames(buffer: Buffer) -> None:
    assert buffer.lookup_transform("map", "laser", Time()).header.stamp.sec == 2
    assert buffer.get_latest_common_time("map", "laser") == Time(seconds=2, nanoseconds=500_000_000)
    assert buffer.lookup_transform("base", "laser", Time()).header.stamp.sec == 0


def test_frame_relative_to_itself_has_its_newest_time(buffer: Buffer) -> None:
    assert buffer.lookup_transform("odom", "odom", Time()).header.stamp.sec == 3
    assert buffer.lookup_transform("odom", "odom", at(2)).header.stamp.sec == 2
    assert buffer.lookup_transform("map", "map", Time()).header.stamp == Time().to_msg()


def test_clear_keeps_static_transforms(buffer: Buffer) -> None:
    buffer.clear()
    assert buffer.can_transform("base", "laser", at(9)) and not buffer.can_transform("map", "odom", at(2))


def test_every_lookup_rejects_unknown_frames(buffer: Buffer) -> None:
    with pytest.raises(LookupException, match='"x" passed to lookupTransform argument fixed_frame does not exist'):
        buffer.lookup_transform_full("map", at(2), "odom", at(2), "x")
    for names, which in ((("x", "map"), "target_frame"), (("map", "x"), "source_frame")):
        with pytest.raises(LookupException, match=f"passed to getLatestCommonTime argument {which} does not exist"):
            buffer.get_latest_common_time(*names)
    assert buffer.can_transform("map", "odom", at(2), return_debug_tuple=True) == (True, "")


REFUSALS: list[tuple[tuple[Any, ...], type[Exception], str]] = [
    (
        ("map", "odom", at(0.5)),
        ExtrapolationException,
        "Lookup would require extrapolation into the past.  Requested time 0.500000 but the earliest data is at time "
        "1.000000, when looking up transform from frame [odom] to frame [map]",
    ),
    (
        ("map", "odom", at(9)),
        ExtrapolationException,
        "Lookup would require extrapolation into the future.  Requested time 9.000000 but the latest data is at time "
        "3.000000, when looking up transform from frame [odom] to frame [map]",
    ),
    (
        ("map", "palm", at(0)),
        ConnectivityException,
        "Could not find a connection between 'map' and 'palm' because they are not part of the same tree."
        "Tf has two or more unconnected trees.",
    ),
    (
        ("map", "nobody", at(0)),
        LookupException,
        '"nobody" passed to lookupTransform argument source_frame does not exist. ',
    ),
    (
        ("", "map", at(0)),
        InvalidArgumentException,
        "Invalid argument passed to lookupTransform argument target_frame in tf2 frame_ids cannot be empty",
    ),
    (
        ("/map", "odom", at(0)),
        InvalidArgumentException,
        'Invalid argument "/map" passed to lookupTransform argument target_frame in tf2 frame_ids cannot start with '
        "a '/'",
    ),
]


@pytest.mark.parametrize(("question", "kind", "words"), REFUSALS, ids=[row[1].__name__ for row in REFUSALS])
def test_failed_lookups_raise_upstreams_errors(
    buffer: Buffer, question: Any, kind: type[Exception], words: str
) -> None:
    with pytest.raises(kind) as caught:
        buffer.lookup_transform(*question)
    assert str(caught.value) == words
    assert buffer.can_transform(*question) is False


def test_single_transform_is_valid_at_its_time_only() -> None:
    buffer = Buffer()
    buffer.set_transform(frame("a", "b", 1.0), "me")
    with pytest.raises(ExtrapolationException, match=r"at time 2\.000000, but only time 1\.000000 is in the buffer"):
        buffer.lookup_transform("a", "b", at(2))


def test_transforms_older_than_cache_time_are_dropped() -> None:
    buffer = Buffer(cache_time=Duration(seconds=2))
    for second in range(1, 7):
        buffer.set_transform(frame("a", "b", second), "me")
    assert buffer.can_transform("a", "b", at(4))
    assert not buffer.can_transform("a", "b", at(3.9))
    usual = Buffer()
    for second in (1, 4.5, 5, 15):
        usual.set_transform(frame("a", "b", second), "me")
    assert usual.can_transform("a", "b", at(5)) and not usual.can_transform("a", "b", at(4.9))


def test_unread_transforms_older_than_cache_time_are_dropped() -> None:
    buffer = Buffer(cache_time=Duration(seconds=2))
    for tenth in range(10 * DIGEST_AFTER):
        buffer.take_messages([frame("a", "b", tenth / 10)])
    assert len(buffer._histories["b"].waiting) <= DIGEST_AFTER + 20
    newest = (10 * DIGEST_AFTER - 1) / 10
    assert buffer.can_transform("a", "b", at(newest - 2)) and not buffer.can_transform("a", "b", at(newest - 2.1))


def test_full_lookup_goes_between_two_times_via_a_fixed_frame(buffer: Buffer) -> None:
    found = buffer.lookup_transform_full("odom", at(3), "odom", at(1), "map")
    assert place(found) == (-3.0, 0.0, 0.0)
    assert found.header.stamp.sec == 3
    assert buffer.can_transform_full("odom", at(3), "odom", at(1), "map")
    answer = buffer.can_transform_full("odom", at(9), "odom", at(1), "map", return_debug_tuple=True)
    assert answer[0] is False and answer[1].startswith("Lookup would require extrapolation into the future.")


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (frame("a", "a"), "TF_SELF_TRANSFORM"),
        (frame("a", ""), "TF_NO_CHILD_FRAME_ID"),
        (frame("", "a"), "TF_NO_FRAME_ID"),
        (frame("a", "b", x=math.nan), "TF_NAN_INPUT"),
        (type(frame("a", "b"))(child_frame_id="b"), "TF_NO_FRAME_ID"),
    ],
)
def test_invalid_transforms_are_ignored_with_a_message(
    capfd: pytest.CaptureFixture[str], wrong: Any, words: str
) -> None:
    buffer = Buffer()
    buffer.set_transform(wrong, "me")
    assert words in capfd.readouterr().err
    assert not buffer.can_transform("a", "b", Time())


@pytest.mark.parametrize(("length", "taken"), [(0.994, False), (0.9955, True), (1.0045, True), (1.006, False)])
@pytest.mark.parametrize("axis", "xyzw")
def test_quaternion_norm_has_upstreams_tolerance(
    capfd: pytest.CaptureFixture[str], axis: str, length: float, taken: bool
) -> None:
    buffer, message = Buffer(), frame("a", "b", 1.0)
    message.transform.rotation.w = 0.0
    setattr(message.transform.rotation, axis, length)
    buffer.set_transform(message, "me")
    assert buffer.can_transform("a", "b", Time()) is taken
    numbers = " ".join(f"{length if each == axis else 0.0:f}" for each in "xyzw")
    words = f"because of an invalid quaternion in the transform ({numbers})"
    assert (words in capfd.readouterr().err) is not taken


def test_repeated_transform_is_ignored_with_a_message(capfd: pytest.CaptureFixture[str], buffer: Buffer) -> None:
    buffer.set_transform(frame("map", "odom", 3.0, 9.0), "you")
    assert place(buffer.lookup_transform("map", "odom", Time()))[0] == 3.0
    assert (
        "TF_REPEATED_DATA ignoring data with redundant timestamp for frame odom (parent map) at time 3.000000 "
        "according to authority you"
    ) in capfd.readouterr().err


def test_loop_is_reported() -> None:
    buffer = Buffer()
    for parent, child in (("a", "b"), ("b", "c"), ("c", "a")):
        buffer.set_transform_static(frame(parent, child), "me")
    buffer.set_transform_static(frame("root", "leaf"), "me")
    with pytest.raises(LookupException, match="it contains a loop"):
        buffer.lookup_transform("root", "a", Time())


def test_geometry_is_transformed_into_another_frame() -> None:
    import tf2_geometry_msgs

    buffer = Buffer()
    buffer.set_transform_static(frame("map", "base", x=1.0, y=2.0, yaw=math.pi / 2), "me")
    point = PointStamped()
    point.header.frame_id, point.point.x = "base", 1.0
    found = buffer.transform(point, "map")
    assert (found.header.frame_id, round(found.point.x, 9), round(found.point.y, 9)) == ("map", 1.0, 3.0)
    vector = Vector3Stamped()
    vector.header.frame_id, vector.vector.x = "base", 1.0
    turned = buffer.transform(vector, "map").vector
    assert (round(turned.x, 9), round(turned.y, 9)) == (0.0, 1.0)
    pose = PoseStamped()
    pose.header.frame_id = "base"
    assert round(buffer.transform(pose, "map").pose.orientation.z, 6) == round(math.sin(math.pi / 4), 6)
    spread = PoseWithCovarianceStamped()
    spread.pose.covariance[0] = 4.0
    covariance = tf2_geometry_msgs.do_transform_pose_with_covariance_stamped(
        spread, buffer.lookup_transform("map", "base", Time())
    ).pose.covariance.reshape(6, 6)
    assert (round(covariance[0, 0], 9), round(covariance[1, 1], 9)) == (0.0, 4.0)


def test_unknown_type_cannot_be_transformed() -> None:
    with pytest.raises(TypeException, match="if not loaded or supported"):
        Buffer().transform(Time(), "map")


def test_message_stamp_is_accepted_as_time(buffer: Buffer) -> None:
    stamp = at(2.5).to_msg()
    wanted = buffer.lookup_transform("map", "laser", at(2.5))
    assert buffer.lookup_transform("map", "laser", stamp) == wanted
    assert buffer.lookup_transform("map", "laser", stamp, Duration(seconds=1)) == wanted
    assert buffer.lookup_transform_full("map", stamp, "laser", stamp, "odom") == wanted
    assert buffer.can_transform("map", "laser", stamp) and not buffer.can_transform("map", "laser", at(9).to_msg())
    with pytest.raises(TypeError, match="time must have sec and nanosec, or nanoseconds"):
        buffer.lookup_transform("map", "laser", 2.5)  # type: ignore[arg-type]
