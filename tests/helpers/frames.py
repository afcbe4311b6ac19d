"""Transforms for tests."""

from __future__ import annotations

import math

from geometry_msgs.msg import TransformStamped


def frame(
    parent: str, child: str, at: float = 0.0, x: float = 0.0, y: float = 0.0, yaw: float = 0.0
) -> TransformStamped:
    """A transform from a parent frame to a child frame at a time (s)."""
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = parent, child
    message.header.stamp.sec, message.header.stamp.nanosec = int(at), round(at % 1 * 10**9)
    message.transform.translation.x, message.transform.translation.y = x, y
    message.transform.rotation.z, message.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def place(message: TransformStamped) -> tuple[float, float, float]:
    """Translation x, y (m) and yaw (rad), rounded."""
    move, turn = message.transform.translation, message.transform.rotation
    return round(move.x, 9), round(move.y, 9), round(2 * math.atan2(turn.z, turn.w), 9)
