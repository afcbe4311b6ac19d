"""The common part of action servers and clients, as entities that an executor serves."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.impl.callables import is_coroutine_function
from rclpy.impl.callback_order import WAITABLE
from rclpy.impl.entity import DESTROYED, Entity
from rclpy.type_support import check_is_valid_action_type
from rclpy.waitable import Waitable

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node


class ActionEntity(Entity, Waitable):
    """A waitable with several endpoints: each wake takes one item from every endpoint that has any."""

    KIND = WAITABLE

    def __init__(self, node: Node, action_type: ServiceType, callback_group: CallbackGroup | None) -> None:
        group = node.default_callback_group if callback_group is None else callback_group
        Entity.__init__(self, group)
        Waitable.__init__(self, group)
        self._node = node
        self._action_type = action_type
        self._endpoints: Any = None

    def _check(self, side: str) -> None:
        """Check that the node can have a new action server or client; raises `ValueError` if its context has ended."""
        check_is_valid_action_type(self._action_type)
        if self._node._ros_destroyed:
            raise InvalidHandle(DESTROYED)
        if not self._node.context.ok():
            raise ValueError(f"Failed to create action {side}: rcl node's context is invalid")

    def _join(self) -> None:
        self._node.add_waitable(self)
        self._node._ros_enter(self, self.callback_group)

    def pending(self) -> bool:
        """Whether anything has arrived."""
        return not self.destroyed and self._endpoints.pending()

    def interfaces(self) -> Sequence[type]:
        """Return the action itself, and those of its interfaces that have type hashes of their own in the graph."""
        impl = self._action_type.Impl
        return (self._action_type, impl.SendGoalService, impl.GetResultService, impl.FeedbackMessage)

    def destroy(self) -> None:
        """Leave the graph; every later use raises `InvalidHandle`."""
        if self.destroyed:
            return
        self.destroyed = True
        self._endpoints.remove()
        self._node.remove_waitable(self)
        self._node._ros_entities.pop(self, None)
        self.detach()


def take(queue: deque[Any]) -> Any:
    """Take the oldest entry of a queue; None if another thread has emptied it meanwhile."""
    try:
        return queue.popleft()
    except IndexError:
        return None


async def call(callback: Callable[..., object], *args: object) -> Any:
    """Call a function, or await the coroutine of a coroutine function."""
    if is_coroutine_function(callback):
        return await callback(*args)
    return callback(*args)
