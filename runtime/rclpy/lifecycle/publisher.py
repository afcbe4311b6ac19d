"""Publishers that are silent while their node is not active."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.impl.reexports import reexporting
from rclpy.lifecycle.managed_entity import SimpleManagedEntity
from rclpy.publisher import Publisher

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """A publisher made by `LifecycleNode.create_lifecycle_publisher`."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        SimpleManagedEntity.__init__(self)
        Publisher.__init__(self, *args, **kwargs)

    @SimpleManagedEntity.when_enabled
    def publish(self, msg: Message | bytes) -> None:
        """Publish a message, or its serialized bytes, if the node is active."""
        Publisher.publish(self, msg)


__getattr__ = reexporting(__name__, "MsgType")
