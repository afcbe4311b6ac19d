"""Publishes transforms that never change."""

from __future__ import annotations

from collections.abc import Iterable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage


class StaticTransformBroadcaster:
    """Publishes static transforms on `/tf_static`; each message contains all so far, and late subscribers get it."""

    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None:
        if qos is None:
            qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST)
        self.pub_tf = node.create_publisher(TFMessage, "/tf_static", qos)
        self.net_message = TFMessage()

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Publish one transform or several; a later one for a frame replaces the earlier one."""
        several = [transform] if isinstance(transform, TransformStamped) else list(transform)
        known = {each.child_frame_id: each for each in self.net_message.transforms}
        known.update({each.child_frame_id: each for each in several})
        self.net_message.transforms = list(known.values())
        self.pub_tf.publish(self.net_message)
