"""Fills a buffer with published transforms."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros.buffer import Buffer
from tf2_ros.static_transform_listener import DEFAULT_STATIC_TF_TOPIC, StaticTransformListener

DEFAULT_TF_TOPIC = "/tf"


class TransformListener(StaticTransformListener):
    """Subscribes to `/tf` and `/tf_static`; the node must be spun, unless `spin_thread` is set."""

    def __init__(
        self,
        buffer: Buffer,
        node: Node,
        *,
        spin_thread: bool = False,
        qos: QoSProfile | int | None = None,
        static_qos: QoSProfile | int | None = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None:
        super().__init__(buffer, node, static_qos=static_qos, tf_static_topic=tf_static_topic)
        qos = QoSProfile(depth=100, history=HistoryPolicy.KEEP_LAST) if qos is None else qos
        self.tf_sub = node.create_subscription(TFMessage, tf_topic, self.callback, qos, callback_group=self.group)
        if spin_thread:
            self._spin_in_a_thread()

    def unregister(self) -> None:
        """Stop listening."""
        self.node.destroy_subscription(self.tf_sub)
        super().unregister()

    def callback(self, data: TFMessage) -> None:
        """Add current transforms."""
        self.buffer.take_messages(data.transforms)  # type: ignore[arg-type] -- a sequence of messages
