"""A quaternion as angles, whatever a node publishes."""

from __future__ import annotations

import math

import pytest
from bot_console.tui.console.topics.angles import angles_text
from geometry_msgs.msg import Quaternion


@pytest.mark.parametrize(
    ("parts", "text"),
    [
        ((0.0, 0.0, 1.0, 1.0), "yaw 90.0°"),
        ((0.0, 0.0, 0.0, 0.0), "not a rotation: its length is 0"),
        ((0.0, 0.0, math.nan, 1.0), "not finite"),
        ((0.0, 0.0, 1e300, 1e300), "yaw 90.0°"),
        ((1.7e308, 1.7e308, 1.7e308, 1.7e308), "not finite"),
        ((0.0, 0.0, 0.0, -math.inf), "not finite"),
    ],
)
def test_a_quaternion_is_shown_as_angles_or_explained(parts: tuple[float, float, float, float], text: str) -> None:
    x, y, z, w = parts
    assert angles_text(Quaternion(x=x, y=y, z=z, w=w)) == text
