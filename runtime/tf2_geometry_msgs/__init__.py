"""Transforms geometry messages, as upstream; after its import, `Buffer.transform` accepts them."""

from geometry_msgs.msg import (
    PointStamped,
    PolygonStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    Vector3Stamped,
    WrenchStamped,
)
from tf2_geometry_msgs.do_transform import (
    do_transform_point,
    do_transform_polygon_stamped,
    do_transform_pose,
    do_transform_pose_stamped,
    do_transform_pose_with_covariance_stamped,
    do_transform_vector3,
    do_transform_wrench,
    transform_covariance,
)
from tf2_ros import ConvertRegistration, TransformRegistration

__all__ = [
    "do_transform_point",
    "do_transform_polygon_stamped",
    "do_transform_pose",
    "do_transform_pose_stamped",
    "do_transform_pose_with_covariance_stamped",
    "do_transform_vector3",
    "do_transform_wrench",
    "from_msg_msg",
    "to_msg_msg",
    "transform_covariance",
]


def to_msg_msg(msg: object) -> object:
    """Return the message unchanged."""
    return msg


def from_msg_msg(msg: object) -> object:
    """Return the message unchanged."""
    return msg


_KNOWN = {
    PointStamped: do_transform_point,
    PolygonStamped: do_transform_polygon_stamped,
    PoseStamped: do_transform_pose_stamped,
    PoseWithCovarianceStamped: do_transform_pose_with_covariance_stamped,
    Vector3Stamped: do_transform_vector3,
    WrenchStamped: do_transform_wrench,
}
for _kind, _function in _KNOWN.items():
    TransformRegistration().add(_kind, _function)
    ConvertRegistration().add_to_msg(_kind, to_msg_msg)
    ConvertRegistration().add_from_msg(_kind, from_msg_msg)
