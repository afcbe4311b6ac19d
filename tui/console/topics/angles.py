"""Converts between quaternions and yaw."""

from __future__ import annotations

import math
from typing import Any

DEGREES = ("°", "deg", "degrees")


def quaternion(yaw: float) -> tuple[float, float, float, float]:
    """The quaternion (x, y, z, w) of a rotation about the vertical axis (rad)."""
    return 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)


def parse_yaw(text: str) -> float:
    """Parse a yaw in rad from `1.57`, `90°` or `90 deg`; raises `ValueError`."""
    words = text.strip().lower().removeprefix("yaw").strip()
    unit = next((each for each in DEGREES if words.endswith(each)), "")
    words = words.removesuffix(unit).removesuffix("rad").strip()
    try:
        value = float(words)
    except ValueError:
        raise ValueError(f"'{text}' is not a yaw; write 90° or 1.57") from None
    if not math.isfinite(value):
        raise ValueError("a yaw must be a finite number")
    return math.radians(value) if unit else value


def angles_text(q: Any) -> str:
    """A quaternion as text in degrees: its yaw, and roll and pitch if they are not zero."""
    norm = math.hypot(q.x, q.y, q.z, q.w)
    if not math.isfinite(norm):
        return "not finite"
    if norm < 1e-6:
        return "not a rotation: its length is 0"
    x, y, z, w = (each / norm for each in (q.x, q.y, q.z, q.w))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    text = f"yaw {math.degrees(yaw):.1f}°"
    if abs(roll) > 1e-3 or abs(pitch) > 1e-3:
        text += f" roll {math.degrees(roll):.1f}° pitch {math.degrees(pitch):.1f}°"
    return text
