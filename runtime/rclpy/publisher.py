"""Publishers."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from bot_console.runtime.process import current
from bot_console.runtime.process.stack_frames import line_outside
from bot_console.runtime.rmw.bus import PublisherEndpoint
from bot_console.runtime.rmw.qos_matching import LATCHING
from bot_console.runtime.rosidl.conversion import FieldTypeError
from bot_console.runtime.rosidl.message import type_shown
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.duration import Duration
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import DESTROYED
from rclpy.impl.reexports import reexporting

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message
    from rclpy.callback_groups import CallbackGroup
    from rclpy.impl.event_handlers import EventHandler
    from rclpy.node_parts.base import NodeBase
    from rclpy.qos import QoSProfile


class Publisher:
    """Publishes messages of one type on one topic; created by `Node.create_publisher`."""

    def __init__(
        self,
        node: NodeBase,
        endpoint: PublisherEndpoint,
        msg_type: type[Message],
        topic: str,
        qos_profile: QoSProfile,
        event_handlers: list[EventHandler],
        group: CallbackGroup,
    ) -> None:
        self._node = node
        self._endpoint = endpoint
        self.msg_type = msg_type
        self.topic = topic
        self.qos_profile = qos_profile
        self.event_handlers = event_handlers
        self.callback_group = group
        self._context = node.context
        self.destroyed = False

    @property
    def handle(self) -> Destroyable:
        """The publisher's handle, as upstream has one."""
        return Destroyable(self, self._use)

    @property
    def topic_name(self) -> str:
        """The fully qualified name after remapping."""
        self._use()
        return self._endpoint.endpoint.topic

    @property
    def logger_name(self) -> str:
        """The name of the node's logger."""
        return self._node.get_logger().name

    def _use(self) -> None:
        if self.destroyed:
            raise InvalidHandle(DESTROYED)

    def publish(self, msg: Message | bytes) -> None:
        """Publish a message, or its serialized bytes; each subscription gets its own copy.

        Raises `TypeError` for another class, `FieldTypeError` (a `TypeError`) for a field of the wrong type.
        """
        if msg.__class__ is not self.msg_type:
            self._publish_other(msg)
            return
        if self.destroyed or self._context.ended:
            self._refuse()
        try:
            self._endpoint.publish(msg)
        except FieldTypeError as error:
            self._explain(error)
            raise

    def _publish_own(self, msg: Message | bytes) -> None:
        """Publish a well-formed message of the right class that nobody else holds."""
        if self.destroyed or self._context.ended:
            self._refuse()
        self._endpoint.publish_own(msg)

    def _is_wanted(self) -> bool:
        """Whether a message would be delivered to a receiver, or kept for late subscriptions."""
        return self._endpoint.is_heard() or self._endpoint.endpoint.qos.durability.name in LATCHING

    def _skip(self) -> None:
        """Do what `_publish_own` does with an unwanted message, so that the caller need not create one."""
        if self.destroyed or self._context.ended:
            self._refuse()
        self._endpoint.skip()

    def _publish_other(self, msg: Message | bytes) -> None:
        if self.destroyed or self._context.ended:
            self._refuse()
        if isinstance(msg, bytes):
            self._endpoint.publish_raw(msg)
        elif isinstance(msg, self.msg_type):
            self._endpoint.publish(msg)
        else:
            raise TypeError(f"Expected {self.msg_type}, got {type_shown(msg)}")

    def _refuse(self, what: str = "Failed to publish") -> None:
        self._use()
        # An interrupt also shuts the context down: the caller should see the interrupt, not this error.
        current().deliver_signals()
        raise RCLError(f"{what}: publisher's context is invalid")

    def _explain(self, error: FieldTypeError) -> None:
        """Log an ERROR that names field, type and the user's line, even if a broadcaster of ours publishes."""
        place = line_outside(sys._getframe(1))  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
        where = f", at {place}" if place else ""
        self._node.get_logger().error(f"cannot publish on '{self._endpoint.endpoint.topic}': {error}{where}")

    def get_subscription_count(self) -> int:
        """Return the number of matched subscriptions; raises `RCLError` after a shutdown of the context."""
        if self.destroyed or self._context.ended:
            self._refuse("failed to get subscription count")
        return self._endpoint.matched_count()

    def _is_heard(self) -> bool:
        """Whether anybody receives messages: a subscription, or an observer that stores them for later."""
        return self._endpoint.is_heard()

    def assert_liveliness(self) -> None:
        """Assert that this publisher is alive, for MANUAL_BY_TOPIC liveliness; raises `RCLError` after a shutdown."""
        if self.destroyed or self._context.ended:
            self._refuse("Failed to assert liveliness on the Publisher")
        self._endpoint.assert_liveliness()

    def wait_for_all_acked(self, timeout: Duration | None = None) -> bool:
        """Whether all reliable subscriptions have received all messages; within a process they receive them at once.

        Raises `RCLError` after a shutdown of the context.
        """
        if self.destroyed or self._context.ended:
            self._refuse("Failed to wait for all acknowledgements")
        return True

    def destroy(self) -> None:
        """Destroy the publisher; every later use raises `InvalidHandle`."""
        for handler in self.event_handlers:
            handler.destroy()
        self.destroyed = True
        self._node._ros_bus.remove(self._endpoint)

    def __enter__(self) -> Publisher:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.destroy()


__getattr__ = reexporting(__name__, "CallbackGroup EventHandler MsgType PublisherEventCallbacks QoSProfile")
