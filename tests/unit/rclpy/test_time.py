"""Points in time and durations."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from builtin_interfaces.msg import Duration as DurationMessage
from builtin_interfaces.msg import Time as TimeMessage
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration, Infinite
from rclpy.time import Time


@pytest.mark.parametrize(
    ("parts", "nanoseconds"),
    [
        ({}, 0),
        ({"seconds": 5}, 5_000_000_000),
        ({"seconds": 1.5}, 1_500_000_000),
        ({"seconds": 1, "nanoseconds": 500}, 1_000_000_500),
        ({"nanoseconds": 1.7}, 1),
        ({"nanoseconds": 2**63 - 1}, 2**63 - 1),
    ],
)
def test_seconds_and_nanoseconds_add_up(parts: dict[str, Any], nanoseconds: int) -> None:
    assert Time(**parts).nanoseconds == nanoseconds
    assert Duration(**parts).nanoseconds == nanoseconds


@pytest.mark.parametrize(
    ("make", "kind", "words"),
    [
        (lambda: Time(seconds=-1), ValueError, "Seconds value must not be negative"),
        (lambda: Time(nanoseconds=-1), ValueError, "Nanoseconds value must not be negative"),
        (
            lambda: Time(seconds=2**63),
            OverflowError,
            "Total nanoseconds value is too large to store in C time point.",
        ),
        (lambda: Time(clock_type=1), TypeError, "Clock type must be a ClockType enum"),
        (
            lambda: Duration(nanoseconds=2**63),
            OverflowError,
            "Total nanoseconds value is too large to store in C duration.",
        ),
        (
            lambda: Duration(nanoseconds=-(2**63) - 1),
            OverflowError,
            "Total nanoseconds value is too large to store in C duration.",
        ),
        (lambda: Time() + Time(), TypeError, "unsupported operand type(s) for +: 'Time' and 'Time'"),
        (lambda: Time() * 2, TypeError, "unsupported operand type(s) for *: 'Time' and 'int'"),
        (lambda: Time(seconds=1) - Duration(seconds=2), ValueError, "Subtraction leads to negative time."),
        (lambda: Time() + Duration(seconds=-1), ValueError, "Nanoseconds value must not be negative"),
        (
            lambda: Time(nanoseconds=2**63 - 1) + Duration(seconds=1),
            OverflowError,
            "Addition leads to overflow in C storage.",
        ),
        (
            lambda: Time() == Time(clock_type=ClockType.ROS_TIME),
            TypeError,
            "Can't compare times with different clock types",
        ),
        (
            lambda: Time() - Time(clock_type=ClockType.STEADY_TIME),
            TypeError,
            "Can't subtract times with different clock types",
        ),
        (lambda: Time.from_msg("x"), TypeError, "Must pass a builtin_interfaces.msg.Time object"),
        (lambda: Duration.from_msg(5), TypeError, "Must pass a builtin_interfaces.msg.Duration object"),
    ],
)
def test_invalid_values_are_rejected(make: Callable[[], Any], kind: type[Exception], words: str) -> None:
    with pytest.raises(kind) as caught:
        make()
    assert str(caught.value) == words


@pytest.mark.parametrize(
    "make",
    [
        lambda: hash(Time()),
        lambda: hash(Duration()),
        lambda: Duration() + Duration(),
        lambda: Duration() * 2,
        lambda: Time() < 5,
        lambda: Duration() < 5,
        lambda: Time() + 1,
    ],
)
def test_unsupported_operations_raise_type_error(make: Callable[[], Any]) -> None:
    with pytest.raises(TypeError):
        make()


def test_times_and_durations_can_be_added_and_subtracted() -> None:
    five, two, second = Time(seconds=5), Time(seconds=2), Duration(seconds=1)
    assert (five - two) == Duration(seconds=3)
    assert (two - five).nanoseconds == -3_000_000_000
    assert five + second == second + five == Time(seconds=6)
    assert five - second == Time(seconds=4)
    ros = Time(seconds=1, clock_type=ClockType.ROS_TIME)
    assert (ros + second).clock_type == ClockType.ROS_TIME


def test_times_can_be_compared() -> None:
    early, late = Time(seconds=1), Time(seconds=2)
    assert early < late and early <= late and late > early and late >= early and early != late
    assert early <= Time(seconds=1) and early == Time(seconds=1)
    assert early != 5 and early is not None
    assert Duration(seconds=-1) < Duration() <= Duration() < Duration(nanoseconds=1)


@pytest.mark.parametrize(
    ("value", "shown", "text"),
    [
        (Time(nanoseconds=5), "Time(nanoseconds=5, clock_type=SYSTEM_TIME)", None),
        (Duration(nanoseconds=5), "Duration(nanoseconds=5)", "5 nanoseconds"),
        (Duration(seconds=-1), "Duration(nanoseconds=-1000000000)", "-1000000000 nanoseconds"),
        (Infinite, "Duration(nanoseconds=9223372036854775807)", "Infinite"),
    ],
)
def test_times_and_durations_print_as_upstream(value: Any, shown: str, text: str | None) -> None:
    assert repr(value) == shown
    assert str(value) == (text or shown)


def test_times_and_durations_convert_to_messages() -> None:
    assert Time(seconds=3, nanoseconds=4).to_msg() == TimeMessage(sec=3, nanosec=4)
    assert Time.from_msg(TimeMessage(sec=3, nanosec=4)).clock_type == ClockType.ROS_TIME
    assert Time.from_msg(TimeMessage(sec=3), clock_type=ClockType.SYSTEM_TIME) == Time(seconds=3)
    assert Duration(seconds=-1.5).to_msg() == DurationMessage(sec=-2, nanosec=500_000_000)
    assert Duration.from_msg(Duration(seconds=-1.5).to_msg()) == Duration(seconds=-1.5)
    assert Time(nanoseconds=1_500_000_001).seconds_nanoseconds() == (1, 500_000_001)


def test_times_are_immutable() -> None:
    with pytest.raises(AttributeError):
        Time().nanoseconds = 5  # type: ignore[misc]


def test_clock_type_of_a_time_prints_by_name_and_equals_the_clocks() -> None:
    for kind in (ClockType.ROS_TIME, ClockType.SYSTEM_TIME, ClockType.STEADY_TIME):
        time = Time(seconds=1, clock_type=kind)
        assert str(time.clock_type) == f"{time.clock_type}" == f"ClockType.{kind.name}"
        assert time.clock_type == kind and kind == time.clock_type and int(time.clock_type) == kind.value
        assert Time(clock_type=time.clock_type) - Time(clock_type=kind) == Duration()
        assert Clock(clock_type=time.clock_type).clock_type is kind
