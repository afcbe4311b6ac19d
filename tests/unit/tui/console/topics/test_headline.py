"""The newest value of a topic in a few words."""

from __future__ import annotations

import math
from typing import Any

import pytest
from bot_console.tui.console.topics.headline import MAX_CHARACTERS, headline
from bot_console.tui.console.topics.meters import MAX_VALUE_BYTES, Meter, value_text
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, Twist, TwistStamped, Vector3
from nav_msgs.msg import Odometry, Path
from rclpy.serialization import serialize_message
from sensor_msgs.msg import BatteryState, Image, Imu, JointState, LaserScan, Range
from std_msgs.msg import Bool, Empty, Float64, String, UInt32

DRIVES = Twist(linear=Vector3(x=0.6), angular=Vector3(z=-0.2))
CASES: list[tuple[Any, str]] = [
    (Float64(data=0.875), "0.88"),
    (Float64(data=0.0), "0"),
    (Float64(data=-123456.0), "-1.23e+05"),
    (Bool(data=False), "false"),
    (UInt32(data=0), "0"),
    (String(data="docked"), "docked"),
    (Empty(), ""),
    (DRIVES, "0.60 m/s  -0.20 rad/s"),
    (Twist(), "0"),
    (Twist(linear=Vector3(y=0.1)), "linear.y 0.10 m/s"),
    (TwistStamped(twist=DRIVES), "0.60 m/s  -0.20 rad/s"),
    (LaserScan(ranges=[1.25, 0.8, math.inf]), "ranges 0.80 .. 1.25 m"),
    (LaserScan(), "ranges empty"),
    (BatteryState(percentage=0.98, voltage=12.59), "percentage 0.98  voltage 12.59 V"),
    (BatteryState(percentage=math.nan, voltage=12.59), "voltage 12.59 V"),
    (Float64(data=math.nan), "nan"),
    (Range(range=math.nan), "range nan"),
    (Image(width=640, height=480, encoding="rgb8"), "640 x 480 pixels  encoding rgb8"),
    (Path(poses=[PoseStamped(), PoseStamped()]), "poses 2"),
    (JointState(name=["a", "b"], position=[0.1, -0.5]), "position -0.50 .. 0.10"),
    (DiagnosticStatus(level=b"\1", message="held"), "level 1 WARN  message held"),
    (Imu(angular_velocity=Vector3(z=0.5), linear_acceleration=Vector3(z=9.81)), "z 0.50 rad/s  z 9.81 m/s²"),
]


@pytest.mark.parametrize(("message", "expected"), CASES, ids=[type(message).__name__ for message, _ in CASES])
def test_message_is_summarised_in_a_few_words(message: Any, expected: str) -> None:
    kind = type(message)
    assert headline(message, f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}") == expected


def test_odometry_says_where_the_robot_is_and_how_it_moves() -> None:
    message = Odometry()
    message.pose.pose = Pose(position=Point(x=-3.2, y=1.0), orientation=Quaternion(w=1.0))
    message.twist.twist = DRIVES
    assert headline(message, "nav_msgs/msg/Odometry") == "x -3.20 m  y 1.00 m  0.60 m/s  -0.20 rad/s"


def test_summary_fits_the_widest_column() -> None:
    assert len(headline(String(data="x" * 10_000), "std_msgs/msg/String")) == MAX_CHARACTERS


def test_bytes_that_are_not_a_message_have_no_value() -> None:
    assert value_text(serialize_message(Float64(data=2.5)), Float64) == "2.50"
    assert value_text(b"\0\1\0\0", Float64) == "" and value_text(b"", Float64) == ""


def test_meter_keeps_newest_message_unless_it_is_too_large() -> None:
    meter = Meter(False, lambda: 1)
    for each in (b"first", b"second"):
        meter.take(each, {"received_timestamp": 1})
    assert meter.newest == b"second"
    meter.take(b"x" * (MAX_VALUE_BYTES + 1), {"received_timestamp": 1})
    assert meter.newest == b"", "the value of an older message is not the newest"
