"""Rotations of frames."""

from __future__ import annotations

import math

from geometry_msgs.msg import Quaternion


def quaternion(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Rotations (rad) about the fixed axes x, then y, then z."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(0.5 * each), math.cos(0.5 * each)) for each in (roll, pitch, yaw))
    return Quaternion(
        x=sr * cp * cy - cr * sp * sy,
        y=cr * sp * cy + sr * cp * sy,
        z=cr * cp * sy - sr * sp * cy,
        w=cr * cp * cy + sr * sp * sy,
    )
