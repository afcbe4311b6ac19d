"""The newest value of a topic in a few words: what a person looks for in a message of that type. Pure functions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from bot_console.tui.console.topics.angles import angles_text
from bot_console.tui.console.topics.field_units import field_unit
from bot_console.tui.console.topics.interfaces import (
    HEADER,
    INTEGERS,
    QUATERNION,
    REALS,
    TIMES,
    constants,
    element_type,
    fields_of,
    is_message,
    short_name,
)
from bot_console.tui.console.topics.message_tree import scalar_text

MAX_PARTS = 4
"""The number of fields shown on the line."""
MAX_CHARACTERS = 80
"""Maximum length of the line, in characters; no column is wider."""
NOT_A_NUMBER = "nan"
"""Left out beside other values, as a zero is, but not if a message contains nothing else."""

PREFERRED: Mapping[str, tuple[str, ...]] = {
    "diagnostic_msgs/DiagnosticStatus": ("level", "message"),
    "geometry_msgs/PoseWithCovarianceStamped": ("pose.pose.position", "pose.pose.orientation"),
    "geometry_msgs/TransformStamped": ("child_frame_id", "transform.translation"),
    "nav_msgs/OccupancyGrid": ("info.width", "info.height", "info.resolution"),
    "nav_msgs/Odometry": ("pose.pose.position", "twist.twist"),
    "nav_msgs/Path": ("poses",),
    "rcl_interfaces/Log": ("name", "msg"),
    "rcl_interfaces/ParameterEvent": ("node",),
    "sensor_msgs/BatteryState": ("percentage", "voltage"),
    "sensor_msgs/CameraInfo": ("width", "height"),
    "sensor_msgs/CompressedImage": ("format", "data"),
    "sensor_msgs/Image": ("width", "height", "encoding"),
    "sensor_msgs/Imu": ("angular_velocity", "linear_acceleration"),
    "sensor_msgs/JointState": ("position",),
    "sensor_msgs/LaserScan": ("ranges",),
    "sensor_msgs/PointCloud2": ("width", "height"),
    "sensor_msgs/Range": ("range",),
}
"""The most informative fields; for other types, the first fields that have a value."""


SELF_EVIDENT = ("position", "point", "translation", "angular_velocity", "linear_acceleration")
"""Vectors whose components are named without the vector."""
UNNAMED: Mapping[str, str] = {"linear.x": "", "angular.z": ""}
"""Speed and turn rate of a base, which need no names because their units differ."""


def headline(message: Any, type_name: str) -> str:
    """A message of a type (`package/msg/Name`) on one line."""
    short = short_name(type_name)
    found = [part for path in PREFERRED.get(short, ()) for part in _parts_at(message, short, path)]
    if [name for name, _ in found[:2]] == ["width", "height"]:
        found = [("", f"{found[0][1].split()[0]} x {found[1][1]}"), *found[2:]]
    if not found:
        found = list(_parts(message, short, "", ""))
    shown = [each for each in found if each[1] not in ("0", "", NOT_A_NUMBER)] or found[:1]
    is_named = len(fields_of(message)) > 1
    return "  ".join(f"{name} {text}" if name and is_named else text for name, text in shown[:MAX_PARTS])[
        :MAX_CHARACTERS
    ]


def _parts_at(message: Any, type_name: str, path: str) -> Iterator[tuple[str, str]]:
    """Names and texts of the parts of a field at a path in a message."""
    *steps, name = path.split(".")
    unit = ""
    for step in steps:
        kind = fields_of(message)[step]
        unit = field_unit(type_name, step, unit)
        message, type_name = getattr(message, step), kind
    yield from _field(message, type_name, name, "", unit)


def _parts(message: Any, type_name: str, above: str, unit: str) -> Iterator[tuple[str, str]]:
    for name, kind in fields_of(message).items():
        if kind != HEADER and "covariance" not in name:
            yield from _field(message, type_name, name, above, unit)


def _field(owner: Any, type_name: str, name: str, above: str, unit: str) -> Iterator[tuple[str, str]]:
    kind, value = fields_of(owner)[name], getattr(owner, name)
    unit = field_unit(type_name, name, unit)
    if kind == QUATERNION:
        yield name, angles_text(value)
    elif kind in TIMES:
        yield name, f"{value.sec + value.nanosec / 1e9:.1f} s"
    elif is_message(kind):
        yield from _parts(value, kind, name, unit)
    elif element := element_type(kind):
        yield name, _array_text(value, element, unit)
    else:
        yield _name(above, name), _value_text(owner, value, name, unit)


def _name(above: str, name: str) -> str:
    """The name of a scalar; a component is named with its vector unless its unit says enough."""
    if len(name) > 1 or above in SELF_EVIDENT:
        return name
    return UNNAMED.get(f"{above}.{name}", f"{above}.{name}" if above else name)


def _value_text(owner: Any, value: Any, name: str, unit: str) -> str:
    if isinstance(value, float):
        return _number(value, unit)
    return scalar_text(value, constants(owner).get(name, {})) + (f" {unit}" if unit else "")


def _number(value: float, unit: str) -> str:
    """A number as short as possible, with its unit unless it is NaN."""
    if math.isnan(value):
        return NOT_A_NUMBER
    text = f"{value:.2f}" if 0.005 <= abs(value) < 1000 else f"{value:.3g}" if abs(value) >= 1000 else "0"
    return f"{text} {unit}" if unit and text != "0" else text


def _array_text(value: Any, element: str, unit: str) -> str:
    count = len(value)
    if not count:
        return "empty"
    if element not in INTEGERS and element not in REALS:
        return str(count)
    numbers = np.asarray(value, float)
    finite = numbers[np.isfinite(numbers)]
    if not finite.size:
        return "none finite"
    least, most = _number(float(finite.min()), ""), _number(float(finite.max()), unit)
    return most if count == 1 else f"{least} .. {most}"
