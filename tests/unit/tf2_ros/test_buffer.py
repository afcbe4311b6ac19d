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
    TransformException,
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
    assert buffer.get_latest_common_time("odom", "odom") == Time(seconds=3)


@pytest.mark.parametrize("name", ["nobody", "", "/odom"])
def test_frame_relative_to_itself_need_not_be_known(buffer: Buffer, name: str) -> None:
    assert buffer.lookup_transform(name, name, at(2)).transform.rotation.w == 1.0
    assert buffer.can_transform(name, name, at(2), return_debug_tuple=True) == (1, "")


def test_clear_keeps_static_transforms(buffer: Buffer) -> None:
    buffer.clear()
    assert buffer.can_transform("base", "laser", at(9)) and not buffer.can_transform("map", "odom", at(2))


def test_frames_stay_known_when_the_buffer_is_cleared(buffer: Buffer) -> None:
    buffer.clear()
    with pytest.raises(ConnectivityException, match="Could not find a connection between 'map' and 'odom'"):
        buffer.lookup_transform("map", "odom", Time())
    with pytest.raises(ExtrapolationException, match=r"^, when looking up transform from frame \[odom\]"):
        buffer.lookup_transform("map", "odom", at(2))


def test_every_lookup_rejects_unknown_frames(buffer: Buffer) -> None:
    for names in (("x", "odom", "map"), ("map", "x", "odom"), ("map", "odom", "x")):
        target, source, fixed = names
        role = ("target", "source", "fixed")[names.index("x")]
        with pytest.raises(
            LookupException, match=f'"x" passed to lookupTransform argument {role}_frame does not exist'
        ):
            buffer.lookup_transform_full(target, at(2), source, at(2), fixed)
        answer = buffer.can_transform_full(target, at(2), source, at(2), fixed, return_debug_tuple=True)
        assert answer == (
            0,
            f'Invalid frame ID "x" passed to canTransform argument {role}_frame - frame does not exist',
        )
    for frames in (("x", "map"), ("map", "x")):
        with pytest.raises(LookupException, match='"x" passed to get_latest_common_time does not exist'):
            buffer.get_latest_common_time(*frames)
    assert buffer.can_transform("map", "odom", at(2), return_debug_tuple=True) == (1, "")


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("x", "frame does not exist"),
        ("", "in tf2 frame_ids cannot be empty"),
        ("/map", "in tf2 frame_ids cannot start with a '/'"),
    ],
)
def test_can_transform_says_which_frame_is_invalid(buffer: Buffer, name: str, problem: str) -> None:
    for frames, role in (((name, "odom"), "target"), (("odom", name), "source")):
        words = f'Invalid frame ID "{name}" passed to canTransform argument {role}_frame - {problem}'
        assert buffer.can_transform(*frames, Time(), return_debug_tuple=True) == (0, words)


def test_latest_common_time_of_unconnected_frames_is_an_error_of_no_particular_class(buffer: Buffer) -> None:
    with pytest.raises(TransformException, match="Could not find a connection") as caught:
        buffer.get_latest_common_time("map", "palm")
    assert type(caught.value) is TransformException


def test_loop_is_described_with_all_frames() -> None:
    buffer = Buffer()
    for parent, child in (("a", "b"), ("b", "a"), ("x", "y")):
        buffer.set_transform(frame(parent, child, 1.0), "me")
    with pytest.raises(LookupException) as caught:
        buffer.lookup_transform("x", "a", at(1))
    assert str(caught.value) == (
        "The tf tree is invalid because it contains a loop.\n"
        "Frame b exists with parent a.\nFrame a exists with parent b.\nFrame y exists with parent x.\n\n"
    )


@pytest.mark.parametrize(
    ("turn", "looked_up"),
    [
        ((0.0, 0.0, 0.0, -1.0), (0.0, 0.0, 0.0, 1.0)),
        ((0.0, 0.0, -0.6, -0.8), (0.0, 0.0, 0.6, 0.8)),
        ((0.0, -1.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)),
        ((0.0, 0.0, -0.96, 0.28), (0.0, 0.0, 0.96, -0.28)),
        ((-0.8, 0.6, 0.0, 0.0), (0.8, -0.6, 0.0, 0.0)),
        ((0.0, 0.0, 0.0, 1.004), (0.0, 0.0, 0.0, 1.0)),
    ],
)
def test_rotations_have_unit_length_and_upstreams_sign(turn: tuple[float, ...], looked_up: tuple[float, ...]) -> None:
    buffer, message = Buffer(), frame("a", "b", 1.0)
    for axis, value in zip("xyzw", turn, strict=True):
        setattr(message.transform.rotation, axis, value)
    buffer.set_transform(message, "me")
    found = buffer.lookup_transform("a", "b", Time()).transform.rotation
    assert (found.x, found.y, found.z, found.w) == pytest.approx(looked_up, abs=1e-12)


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
        'Invalid argument "" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot be empty',
    ),
    (
        ("/map", "odom", at(0)),
        InvalidArgumentException,
        'Invalid argument "/map" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot start '
        "with a '/'",
    ),
]


@pytest.mark.parametrize(("question", "kind", "words"), REFUSALS, ids=[row[1].__name__ for row in REFUSALS])
def test_failed_lookups_raise_upstreams_errors(
    buffer: Buffer, question: Any, kind: type[Exception], words: str
) -> None:
    with pytest.raises(kind) as caught:
        buffer.lookup_transform(*question)
    assert str(caught.value) == words
    assert buffer.can_transform(*question) == 0


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
    assert answer[0] == 0 and answer[1].startswith("Lookup would require extrapolation into the future.")


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
    assert bool(buffer.can_transform("a", "b", Time())) is taken
    numbers = " ".join(f"{length if each == axis else 0.0:f}" for each in "xyzw")
    words = f"because of an invalid quaternion in the transform ({numbers})"
    assert (words in capfd.readouterr().err) is not taken


def test_later_one_of_two_transforms_with_one_time_counts(buffer: Buffer) -> None:
    buffer.set_transform(frame("map", "odom", 3.0, 9.0), "you")
    assert place(buffer.lookup_transform("map", "odom", Time()))[0] == 9.0


def test_transform_older_than_the_buffer_is_ignored_with_a_message(capfd: pytest.CaptureFixture[str]) -> None:
    buffer = Buffer()
    for second in (20.0, 5.0):
        buffer.set_transform(frame("map", "odom", second), "you")
    assert (
        "TF_OLD_DATA ignoring data from the past for frame odom at time 5.000000 according to authority you\n"
        "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained"
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
