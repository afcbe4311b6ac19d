"""Forms: the values of fields, what may be typed into them, and the resulting message."""

from __future__ import annotations

import math

import pytest
from bot_console.tui.console.topics.forms import filled, slots, stamp, typed_fields, wrong
from bot_console.tui.console.topics.message_tree import tree
from bot_console.tui.console.topics.port import Payload
from builtin_interfaces.msg import Time
from sensor_msgs.msg import BatteryState, Image, LaserScan

ODOM, BATTERY, SCAN = "nav_msgs/msg/Odometry", "sensor_msgs/msg/BatteryState", "sensor_msgs/msg/LaserScan"


def test_a_form_has_defaults_units_and_the_names_of_enumerations() -> None:
    found = {each.path: each for each in slots(Payload.MESSAGE, BATTERY, {"voltage": "12.5"})}
    assert found["header.stamp"].text == "now"
    assert (found["voltage"].text, found["voltage"].unit) == ("12.5", "V")
    assert "1 CHARGING" in found["power_supply_status"].choices
    assert "1 GOOD" in found["power_supply_health"].choices, "each field has its own names"


def test_a_yaw_may_be_typed_for_a_quaternion() -> None:
    message, _ = filled(Payload.MESSAGE, ODOM, {"pose.pose.orientation": "90°", "pose.pose.position.x": "2"})
    q = message.pose.pose.orientation
    assert (q.x, q.y) == (0.0, 0.0) and math.isclose(q.z, math.sqrt(0.5)) and math.isclose(q.w, math.sqrt(0.5))
    radians, _ = filled(Payload.MESSAGE, ODOM, {"pose.pose.orientation": str(math.pi / 2)})
    assert math.isclose(radians.pose.pose.orientation.z, q.z)
    shown = {each.path for each in slots(Payload.MESSAGE, ODOM, {"pose.pose.orientation": "90°"})}
    assert "pose.pose.orientation" in shown and "pose.pose.orientation.z" not in shown


def test_stamps_are_set_at_each_sending_unless_a_time_was_given() -> None:
    message, now = filled(Payload.MESSAGE, ODOM, {})
    stamp(message, now, lambda: Time(sec=7))
    assert message.header.stamp.sec == 7
    message, now = filled(Payload.MESSAGE, ODOM, {"header.stamp": "1.5"})
    assert not now and (message.header.stamp.sec, message.header.stamp.nanosec) == (1, 500_000_000)


def test_enumerations_are_typed_by_name_or_number() -> None:
    for text in ("CHARGING", "charging", "1", "1 CHARGING", "0x1"):
        message, _ = filled(Payload.MESSAGE, BATTERY, {"power_supply_status": text})
        assert message.power_supply_status == 1, text


@pytest.mark.parametrize(
    ("type_name", "path", "text", "output"),
    [
        (BATTERY, "voltage", "much", "not a number"),
        (BATTERY, "power_supply_status", "256", "does not fit into uint8: 0 .. 255"),
        (BATTERY, "power_supply_status", "BOILING", "one of UNKNOWN"),
        (BATTERY, "present", "perhaps", "neither true nor false"),
        (BATTERY, "colour", "1", "there is no field colour"),
        (SCAN, "ranges", "1.0, 2.0", "as in YAML"),
        (SCAN, "ranges", "[far]", "not a number"),
        (ODOM, "pose.covariance", "[1.0]", "the array has 36"),
        (ODOM, "pose.pose.orientation", "north", "not a yaw"),
        (ODOM, "header.stamp", "soon", "not a number"),
    ],
)
def test_an_invalid_text_for_a_field_is_explained(type_name: str, path: str, text: str, output: str) -> None:
    assert output in wrong(Payload.MESSAGE, type_name, path, text)
    with pytest.raises(ValueError, match=output.split(maxsplit=1)[0]):
        filled(Payload.MESSAGE, type_name, {path: text})


def test_arrays_including_those_of_messages_are_typed_as_yaml() -> None:
    message, _ = filled(Payload.MESSAGE, SCAN, {"ranges": "[1.0, .inf, 3]"})
    assert list(message.ranges) == [1.0, math.inf, 3.0]
    path, _ = filled(Payload.MESSAGE, "geometry_msgs/msg/Polygon", {"points": "[{x: 1.0, y: 2.0}]"})
    assert (path.points[0].x, path.points[0].y) == (1.0, 2.0)


def test_a_command_line_contains_only_typed_fields_and_now() -> None:
    fields = typed_fields(Payload.MESSAGE, ODOM, {"child_frame_id": "base", "twist.twist.linear.x": "0.5"})
    assert fields == {
        "header": {"stamp": "now"}, "child_frame_id": "base", "twist": {"twist": {"linear": {"x": 0.5}}},
    }  # fmt: skip


def test_an_unknown_type_is_reported_with_a_hint() -> None:
    with pytest.raises(ValueError, match="not available here; source the workspace"):
        slots(Payload.MESSAGE, "nowhere_msgs/msg/Nothing", {})


def test_a_long_array_and_an_image_are_shown_as_summaries() -> None:
    scan = LaserScan(ranges=[1.0, 3.0, math.inf] * 120)
    texts = {each.path: each.text for each in tree(scan, SCAN)}
    assert texts["ranges"] == "360 values, 1 .. 3, mean 2, 120 not finite"
    image = Image(width=64, height=48, encoding="rgb8", data=bytes(64 * 48 * 3))
    texts = {each.path: each.text for each in tree(image, "sensor_msgs/msg/Image")}
    assert texts["data"] == "image of 64 x 48, rgb8, 9216 bytes"


def test_a_tree_shows_enumeration_names_units_and_angles() -> None:
    texts = {each.path: each for each in tree(BatteryState(voltage=12.5, power_supply_status=1), BATTERY)}
    assert texts["power_supply_status"].text == "1 CHARGING"
    assert (texts["voltage"].text, texts["voltage"].unit, texts["voltage"].number) == ("12.5", "V", True)
    message, _ = filled(Payload.MESSAGE, ODOM, {"pose.pose.orientation": "-90°"})
    lines = {each.path: each for each in tree(message, ODOM)}
    assert lines["pose.pose.orientation"].text == "yaw -90.0°"
    assert lines["twist.twist.angular.z"].unit == "rad/s"
    whole = [each.path for each in tree(message, ODOM)]
    at = whole.index("pose")
    assert all(each.startswith("pose.") for each in whole[at + 1 : at + 1 + lines["pose"].holds])
    assert not whole[at + 1 + lines["pose"].holds].startswith("pose.")
