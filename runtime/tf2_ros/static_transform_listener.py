"""Fills a buffer with transforms that never change."""

from __future__ import annotations

import threading
from contextlib import suppress
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros.buffer import Buffer

DEFAULT_STATIC_TF_TOPIC = "/tf_static"


class StaticTransformListener:
    """Subscribes to `/tf_static`; the node must be spun, unless `spin_thread` is set."""

    def __init__(
        self,
        buffer: Buffer,
        node: Node,
        *,
        spin_thread: bool = False,
        static_qos: QoSProfile | int | None = None,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None:
        self.buffer = buffer
        self.node = node
        self.group = ReentrantCallbackGroup()
        if isinstance(buffer, Buffer):  # pyright: ignore[reportUnnecessaryIsInstance] -- or a program's own
            buffer.follow_clock(node)
        if static_qos is None:
            static_qos = QoSProfile(
                depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST
            )
        self.tf_static_sub = node.create_subscription(
            TFMessage, tf_static_topic, self.static_callback, static_qos, callback_group=self.group
        )
        if spin_thread:
            self._spin_in_a_thread()

    def _spin_in_a_thread(self) -> None:
        self.executor = SingleThreadedExecutor(context=self.node.context)
        self.executor.add_node(self.node)
        self.dedicated_listener_thread = threading.Thread(target=self._spin, daemon=True)
        self.dedicated_listener_thread.start()

    def _spin(self) -> None:
        with suppress(ExternalShutdownException):
            self.executor.spin()

    def __del__(self) -> None:
        executor: Any = getattr(self, "executor", None)
        if executor is not None:
            executor.shutdown(0)

    def unregister(self) -> None:
        """Stop listening."""
        self.node.destroy_subscription(self.tf_static_sub)

    def static_callback(self, data: TFMessage) -> None:
        """Add static transforms."""
        for each in data.transforms:
            self.buffer.set_transform_static(each, "default_authority")
