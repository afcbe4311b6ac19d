"""`sensor_msgs/PointCloud2` as NumPy arrays, and back. Contract: upstream's `sensor_msgs_py.point_cloud2`."""

from __future__ import annotations

import array
import sys
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py.numpy_compat import structured_to_unstructured
from std_msgs.msg import Header

DUMMY_FIELD_PREFIX = "unnamed_field"

_DATATYPES: dict[int, np.dtype[Any]] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
}


def read_points(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """Return the points as a structured array; optionally only some fields, no NaN, only points by index."""
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    points = _points(cloud)
    if field_names is not None:
        missing = set(field_names) - set(points.dtype.names or ())
        assert not missing, f"Requests field is not in the fields of the PointCloud: {', '.join(sorted(missing))}"
        points = points[list(field_names)]
    if skip_nans and not cloud.is_dense:
        points = points[~_with_nan(points)]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def _points(cloud: PointCloud2) -> np.ndarray:
    """Return all points in one row; the rows of the image may have padding."""
    dtype = dtype_from_fields(cloud.fields, cloud.point_step)
    if bool(sys.byteorder != "little") != bool(cloud.is_bigendian):
        dtype = dtype.newbyteorder()
    data = np.frombuffer(bytes(cloud.data), dtype=np.uint8)
    used = cloud.width * cloud.point_step
    if cloud.height > 1 and cloud.row_step > used:
        data = np.ascontiguousarray(data[: cloud.height * cloud.row_step].reshape(cloud.height, -1)[:, :used])
    return np.frombuffer(data.tobytes(), dtype=dtype, count=cloud.width * cloud.height).copy()


def _with_nan(points: np.ndarray) -> np.ndarray:
    """Return which points have NaN in any field."""
    found = np.zeros(points.shape, dtype=bool)
    for name in points.dtype.names or ():
        values = points[name]
        if values.dtype.kind == "f":
            bad = np.isnan(values)
            found |= bad if bad.ndim == found.ndim else bad.any(axis=-1)
    return found


def read_points_numpy(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """Return the points as rows of a plain array; all selected fields must have the same type."""
    fields = [each for each in cloud.fields if field_names is None or each.name in field_names]
    assert all(each.datatype == fields[0].datatype for each in fields[1:]), (
        "All fields need to have the same datatype. Use `read_points()` otherwise."
    )
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    return structured_to_unstructured(points)


def read_points_list(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
) -> list[Any]:
    """Return the points as a list of named tuples."""
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    names = [each.name for each in cloud.fields] if field_names is None else list(field_names)
    point: Any = NamedTuple("Point", [(name, Any) for name in names])  # type: ignore[misc] -- fields are known at run time only
    return [point._make(each) for each in read_points(cloud, names, skip_nans, uvs).tolist()]


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype:
    """Return the type of a point: its fields at their offsets; unnamed fields get names."""
    names: list[str] = []
    offsets: list[int] = []
    formats: list[Any] = []
    for index, field in enumerate(fields):
        kind = _DATATYPES[field.datatype]
        name = field.name or f"{DUMMY_FIELD_PREFIX}_{index}"
        assert field.count > 0, "Can't process fields with count = 0."
        for part in range(field.count):
            names.append(f"{name}_{part}" if field.count > 1 else name)
            assert names[-1] not in names[:-1], "Duplicate field names are not allowed!"
            offsets.append(field.offset + part * kind.itemsize)
            formats.append(kind)
    layout: Any = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        layout["itemsize"] = point_step
    return np.dtype(layout)


def create_cloud(
    header: Header,
    fields: Iterable[PointField],
    points: object,
    step: int | None = None,
    point_step: int | None = None,
) -> PointCloud2:
    """Return a cloud of points given as rows of an array, a list of tuples, or a structured array.

    A point takes `step` bytes; by default as many as in the structured array, or as its fields need.
    """
    fields = list(fields)
    step = step or point_step
    if step is None and isinstance(points, np.ndarray) and points.dtype.names is not None:
        step = points.dtype.itemsize
    dtype = dtype_from_fields(fields, step)
    if isinstance(points, np.ndarray) and points.dtype.names is None:
        assert all(each.datatype == fields[0].datatype for each in fields[1:]), (
            "All fields need to have the same datatype. Pass a structured NumPy array with multiple dtypes otherwise."
        )
    points = _structured(points, dtype)
    assert points.dtype == dtype, (
        "PointFields and structured NumPy array dtype do not match for all fields! "
        "Check their field order, names and types."
    )
    assert points.ndim <= 2, "Too many dimensions for organized cloud! Points can only be organized in max. two dims"
    height, width = (1, len(points)) if points.ndim == 1 else (points.shape[1], points.shape[0])
    cloud = PointCloud2(header=header, height=height, width=width, fields=fields, is_dense=False)
    cloud.is_bigendian = sys.byteorder != "little"
    cloud.point_step = dtype.itemsize
    cloud.row_step = dtype.itemsize * width
    cloud.data = array.array("B", points.tobytes())
    return cloud


def _structured(points: Any, dtype: np.dtype) -> np.ndarray:
    """Return points as a structured array with a type."""
    if isinstance(points, np.ndarray) and points.dtype.names is not None:
        return points
    if isinstance(points, np.ndarray):
        found = np.empty(points.shape[:-1], dtype=dtype)
        assert len(dtype.names or ()) == points.shape[-1], "Fields and columns of the points do not match."
        for index, name in enumerate(dtype.names or ()):
            found[name] = points[..., index]
        return found
    return np.array([tuple(each) for each in points], dtype=dtype)


def create_cloud_xyz32(
    header: Header, points: object, step: int | None = None, point_step: int | None = None
) -> PointCloud2:
    """Return a cloud of points with x, y and z (m) in single precision."""
    fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points, step, point_step)
