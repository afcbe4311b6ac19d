"""CDR is written and read in one pass: large arrays are copied once, and concurrent changes do no harm."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable
from typing import Any, cast

import numpy
import pytest
from bot_console.runtime.rosidl.cdr import deserialize, serialize
from geometry_msgs.msg import Point
from rcl_interfaces.msg import ParameterValue
from sensor_msgs.msg import Image, PointCloud2, PointField
from std_msgs.msg import Bool, Float32, Int32, String
from trajectory_msgs.msg import JointTrajectoryPoint

SIZE = 1_000_000


class Text(str):
    """A subclass of str defined by a program."""


class Own(String):
    """A message subclass defined by a program."""


class CallingInt:
    """An integer that calls a function when it is converted."""

    def __init__(self, do: Callable[[], Any]) -> None:
        self._do = do

    def __index__(self) -> int:
        self._do()
        return 1


def peak_memory(do: Callable[[], Any]) -> int:
    """The largest number of bytes allocated at any time."""
    do()
    tracemalloc.start()
    try:
        do()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_byte_array_is_copied_once() -> None:
    image = Image(data=bytes(SIZE))
    written = serialize(image)
    assert peak_memory(lambda: serialize(image)) < 1.5 * SIZE
    assert peak_memory(lambda: deserialize(written, Image)) < 1.5 * SIZE


@pytest.mark.parametrize(
    ("message", "same"),
    [
        (Point(x=numpy.float64(1.5)), Point(x=1.5)),
        (Float32(data=numpy.float64(1e300)), Float32(data=float("inf"))),
        (Int32(data=True), Int32(data=1)),
        (Bool(data=cast("bool", numpy.bool_(True))), Bool(data=True)),
        (String(data="a\0b"), String(data="a")),
        (String(data=Text("a")), String(data="a")),
        (Own(data="a"), String(data="a")),
        (ParameterValue(string_array_value=("a\0b", Text("c"))), ParameterValue(string_array_value=["a", "c"])),
        (ParameterValue(byte_array_value=cast("list[bytes]", b"ab")), ParameterValue(byte_array_value=[b"a", b"b"])),
    ],
)
def test_values_of_similar_types_are_written_like_converted_copies(message: Any, same: Any) -> None:
    assert serialize(message) == serialize(message._copy_()) == serialize(same)


@pytest.mark.parametrize(
    "message",
    [String(data="\ud800"), String(data="a\0\udcff"), ParameterValue(string_array_value=["é", "\udcff"])],
)
def test_string_with_lone_surrogate_is_rejected_by_copies_as_on_the_wire(message: Any) -> None:
    for copy in (serialize, lambda value: value._copy_()):
        with pytest.raises(UnicodeEncodeError):
            copy(message)


def test_array_growing_during_serialization_is_written_consistently() -> None:
    point = JointTrajectoryPoint(positions=[1.0])
    point.time_from_start.sec = cast("int", CallingInt(lambda: point.positions.append(2.0)))
    read = deserialize(serialize(point), JointTrajectoryPoint)
    assert (read.time_from_start.sec, read.positions[0]) == (1, 1.0)


def test_list_growing_during_serialization_is_written_as_it_was() -> None:
    cloud = PointCloud2(fields=[PointField(name="x")])
    cloud.fields[0].offset = cast("int", CallingInt(lambda: cloud.fields.append(PointField(name="y"))))
    assert deserialize(serialize(cloud), PointCloud2).fields == [PointField(name="x", offset=1)]
