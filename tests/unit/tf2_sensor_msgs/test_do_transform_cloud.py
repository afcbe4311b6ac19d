"""Point clouds transformed from one frame to another."""

from __future__ import annotations

import math

import numpy as np
import pytest
import tf2_sensor_msgs
from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from sensor_msgs_py.point_cloud2 import create_cloud_xyz32, read_points_numpy
from std_msgs.msg import Header
from tf2_ros import Buffer

POINTS = [(1.0, 0.0, 0.0), (0.0, 2.0, 3.0)]


def quarter_turn() -> TransformStamped:
    """A turn by 90 degrees about z, then 1 m along x."""
    transform = TransformStamped(header=Header(frame_id="map"), child_frame_id="laser")
    transform.transform.translation.x = 1.0
    transform.transform.rotation.z = transform.transform.rotation.w = math.sqrt(0.5)
    return transform


def test_points_are_rotated_and_translated() -> None:
    cloud = create_cloud_xyz32(Header(frame_id="laser"), POINTS)
    moved = tf2_sensor_msgs.do_transform_cloud(cloud, quarter_turn())
    assert moved.header.frame_id == "map"
    assert read_points_numpy(moved) == pytest.approx(np.array([(1.0, 1.0, 0.0), (-1.0, 0.0, 3.0)]), abs=1e-6)
    assert read_points_numpy(cloud) == pytest.approx(np.array(POINTS))


def test_buffer_transforms_clouds() -> None:
    buffer = Buffer()
    buffer.set_transform_static(quarter_turn(), "test")
    cloud = create_cloud_xyz32(Header(frame_id="laser", stamp=Time().to_msg()), POINTS)
    assert read_points_numpy(buffer.transform(cloud, "map"))[0] == pytest.approx((1.0, 1.0, 0.0), abs=1e-6)


def test_arrays_of_points_are_transformed() -> None:
    moved = tf2_sensor_msgs.transform_points(np.array(POINTS), quarter_turn().transform)
    assert moved == pytest.approx(np.array([(1.0, 1.0, 0.0), (-1.0, 0.0, 3.0)]))
