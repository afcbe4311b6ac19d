"""One function per kind of geometry message, which returns the message in the transform's frame."""

from __future__ import annotations

from typing import Any

import numpy as np
from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    Vector3,
    Vector3Stamped,
    WrenchStamped,
)
from tf2_py.rigid import Rigid, compose

ORIGIN = (0.0, 0.0, 0.0)
UPRIGHT = (0.0, 0.0, 0.0, 1.0)
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def _rigid(transform: TransformStamped) -> Rigid:
    move, turn = transform.transform.translation, transform.transform.rotation
    return (move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w)


def _moved(place: Rigid, point: Any) -> tuple[float, float, float]:
    return compose(place, (point.x, point.y, point.z, *UPRIGHT))[:3]


def _turned(place: Rigid, vector: object) -> tuple[float, float, float]:
    return _moved((*ORIGIN, *place[3:]), vector)  # type: ignore[arg-type] -- numpy numbers count as numbers


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """Transform a point: rotate and translate it."""
    x, y, z = _moved(_rigid(transform), point.point)
    return PointStamped(header=transform.header, point=Point(x=x, y=y, z=z))


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """Transform a direction, which is only rotated."""
    x, y, z = _turned(_rigid(transform), vector3.vector)
    return Vector3Stamped(header=transform.header, vector=Vector3(x=x, y=y, z=z))


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """Transform a pose without a header."""
    at, turn = pose.position, pose.orientation
    x, y, z, qx, qy, qz, qw = compose(_rigid(transform), (at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w))
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """Transform a pose with a header."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_polygon_stamped(polygon: PolygonStamped, transform: TransformStamped) -> PolygonStamped:
    """Transform all points of a polygon."""
    place = _rigid(transform)
    result = PolygonStamped(header=transform.header)
    for each in polygon.polygon.points:
        x, y, z = _moved(place, each)
        result.polygon.points.append(Point32(x=x, y=y, z=z))
    return result


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """Transform a pose and its 6x6 covariance."""
    result = PoseWithCovarianceStamped(header=transform.header)
    result.pose.pose = do_transform_pose(pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def do_transform_wrench(wrench: WrenchStamped, transform: TransformStamped) -> WrenchStamped:
    """Transform force and torque, which are only rotated."""
    place = _rigid(transform)
    result = WrenchStamped(header=transform.header)
    for name in ("force", "torque"):
        x, y, z = _turned(place, getattr(wrench.wrench, name))
        setattr(result.wrench, name, Vector3(x=x, y=y, z=z))
    return result


def transform_covariance(cov_in: Any, transform: Any) -> np.ndarray:
    """Rotate both halves of a 6x6 covariance (row by row) by a `Transform` or a `TransformStamped`."""
    turn = getattr(transform, "transform", transform).rotation
    place: Rigid = (*ORIGIN, turn.x, turn.y, turn.z, turn.w)
    rotation = np.array([compose(place, (x, y, z, *UPRIGHT))[:3] for x, y, z in AXES]).T
    both = np.kron(np.identity(2), rotation)
    return (both @ np.asarray(cov_in, dtype=np.float64).reshape(6, 6) @ both.T).ravel()
