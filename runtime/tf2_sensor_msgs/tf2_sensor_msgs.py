"""Transforms point clouds between frames. After its import, `Buffer.transform` accepts them."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import tf2_ros
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import PointCloud2
from sensor_msgs_py.point_cloud2 import create_cloud, read_points

XYZ = ["x", "y", "z"]


def to_msg_msg(msg: object) -> Any:
    """Return the cloud unchanged."""
    return msg


def from_msg_msg(msg: object) -> Any:
    """Return the cloud unchanged."""
    return msg


def transform_points(point_cloud: np.ndarray, transform: Transform) -> np.ndarray:
    """Rotate and translate points (N, 3)."""
    turn, move = transform.rotation, transform.translation
    x, y, z, w = turn.x, turn.y, turn.z, turn.w
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    return point_cloud @ rotation.T + (move.x, move.y, move.z)


def do_transform_cloud(cloud: PointCloud2, transform: TransformStamped) -> PointCloud2:
    """Return the cloud in the transform's frame; all fields other than x, y and z are unchanged."""
    points = read_points(cloud)
    moved = transform_points(np.stack([points[name] for name in XYZ], axis=-1), transform.transform)
    result = points.copy()
    for column, name in enumerate(XYZ):
        result[name] = moved[..., column]
    return create_cloud(copy.copy(transform.header), cloud.fields, result)


tf2_ros.ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
tf2_ros.ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
tf2_ros.TransformRegistration().add(PointCloud2, do_transform_cloud)
