"""Point clouds as arrays and back."""

from __future__ import annotations

import numpy as np
import pytest
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header

FIELDS = [
    PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1),
    PointField(name="y", offset=4, datatype=PointField.FLOAT32, count=1),
    PointField(name="z", offset=8, datatype=PointField.FLOAT32, count=1),
    PointField(name="ring", offset=16, datatype=PointField.UINT16, count=1),
]
POINTS = [(1.0, 2.0, 3.0, 4), (np.nan, 2.0, 3.0, 5), (7.0, 8.0, 9.0, 6)]


@pytest.fixture
def cloud() -> PointCloud2:
    return point_cloud2.create_cloud(Header(frame_id="lidar"), FIELDS, POINTS)


def test_cloud_has_the_expected_layout(cloud: PointCloud2) -> None:
    assert (cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (1, 3, 18, 54)
    assert (cloud.header.frame_id, cloud.is_dense, len(cloud.data)) == ("lidar", False, 54)


def test_points_are_read_as_arrays_or_lists(cloud: PointCloud2) -> None:
    points = point_cloud2.read_points(cloud)
    assert points.dtype.names == ("x", "y", "z", "ring")
    assert points["ring"].tolist() == [4, 5, 6]
    assert point_cloud2.read_points(cloud, ["ring", "x"], skip_nans=True).tolist() == [(4, 1.0), (6, 7.0)]
    assert point_cloud2.read_points(cloud, ["x"], uvs=[2, 0])["x"].tolist() == [7.0, 1.0]
    assert point_cloud2.read_points(cloud, ["x"], True, np.array([1]))["x"].tolist() == [7.0], "of those without NaN"
    with pytest.raises(AssertionError, match=r"Cloud is not a sensor_msgs\.msg\.PointCloud2"):
        point_cloud2.read_points(Header())  # type: ignore[arg-type] -- a usual mistake
    with pytest.raises(AssertionError, match="All fields need to have the same datatype"):
        point_cloud2.create_cloud(Header(), FIELDS, np.zeros((2, 4)))
    assert point_cloud2.read_points_numpy(cloud, ["x", "y", "z"], skip_nans=True).tolist() == [[1, 2, 3], [7, 8, 9]]
    first = point_cloud2.read_points_list(cloud)[0]
    assert (first.x, first.ring) == (1.0, 4)
    with pytest.raises(AssertionError, match="same datatype"):
        point_cloud2.read_points_numpy(cloud)
    with pytest.raises(AssertionError, match="not in the fields"):
        point_cloud2.read_points(cloud, ["intensity"])


def test_cloud_is_created_from_an_array() -> None:
    places = np.random.default_rng(1).random((5, 3)).astype(np.float32)
    cloud = point_cloud2.create_cloud_xyz32(Header(), places)
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(cloud), places)


def test_padded_big_endian_points_with_vectors_are_read() -> None:
    field = PointField(name="v", offset=4, datatype=PointField.FLOAT64, count=2)
    data = np.zeros(2, np.dtype({"names": ["v"], "formats": [(">f8", 2)], "offsets": [4], "itemsize": 24}))
    data["v"] = [[1, 2], [3, 4]]
    cloud = PointCloud2(height=1, width=2, fields=[field], is_bigendian=True, point_step=24, row_step=48)
    cloud.data = data.tobytes()
    assert point_cloud2.read_points(cloud).tolist() == [(1.0, 2.0), (3.0, 4.0)]
    assert point_cloud2.dtype_from_fields([field]).names == ("v_0", "v_1")


def test_structured_array_keeps_its_item_size() -> None:
    fields = [PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1)]
    padded = np.zeros(2, np.dtype({"names": ["x"], "formats": ["f4"], "offsets": [0], "itemsize": 20}))
    assert point_cloud2.create_cloud(Header(), fields, padded).point_step == 20
    with pytest.raises(AssertionError, match="do not match"):
        point_cloud2.create_cloud(Header(), fields, padded, 4)
