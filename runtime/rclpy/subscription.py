"""Subscriptions."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import HeldMessage, SubscriptionEndpoint, take_queued
from rclpy._rclpy_pybind11 import RCLError
from rclpy.impl.callables import accepts_arguments, is_coroutine_function
from rclpy.impl.callback_order import SUBSCRIPTION
from rclpy.impl.destroyable import SubscriptionHandle
from rclpy.impl.entity import Entity
from rclpy.impl.reexports import reexporting
from rclpy.subscription_content_filter_options import ContentFilterOptions

if TYPE_CHECKING:
    from types import TracebackType

    from bot_console.runtime.rmw.endpoints import Arrival
    from bot_console.runtime.rosidl.message import Message
    from rclpy.callback_groups import CallbackGroup
    from rclpy.impl.event_handlers import EventHandler
    from rclpy.node_parts.base import NodeBase
    from rclpy.qos import QoSProfile

DOUBLE_ARGUMENT, SINGLE_ARGUMENT = 2, 1


class Subscription(Entity):
    """Calls back with each message of a topic; created by `Node.create_subscription`."""

    KIND = SUBSCRIPTION

    class CallbackType(Enum):
        """Whether the callback takes only the message, or its info as well."""

        MessageOnly = 0
        WithMessageInfo = 1

    def __init__(
        self,
        node: NodeBase,
        msg_type: type[Message],
        topic: str,
        callback: Callable[..., object],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
        raw: bool,
        event_handlers: list[EventHandler],
    ) -> None:
        super().__init__(callback_group)
        self._node = node
        self.msg_type = msg_type
        self.topic = topic
        self.raw = raw
        self.qos_profile = qos_profile
        self.event_handlers = event_handlers
        self.endpoint: SubscriptionEndpoint
        self._queue: deque[Arrival] = deque()
        self._content_filter: ContentFilterOptions | None = None
        self.callback = callback

    def _join(self, endpoint: SubscriptionEndpoint) -> None:
        self.endpoint = endpoint
        self._queue = endpoint.queue

    @property
    def handle(self) -> SubscriptionHandle:
        """The subscription's handle, as upstream has one."""
        return SubscriptionHandle(self, self.use)

    @property
    def callback(self) -> Callable[..., object]:
        """The function that is called with `(message)` or `(message, info)`."""
        return self._callback

    @callback.setter
    def callback(self, value: Callable[..., object]) -> None:
        self._callback = value
        self._callback_type = Subscription.CallbackType.MessageOnly
        self._message_only = True
        self._is_async = is_coroutine_function(value)
        try:
            if accepts_arguments(value, 1):
                return
        except ValueError:
            return
        if accepts_arguments(value, 2):
            self._callback_type = Subscription.CallbackType.WithMessageInfo
            self._message_only = False
            return
        raise RuntimeError(
            "Subscription.__init__(): callback should be either be callable with one argument"
            "(to get only the message) or two (to get message and message info)"
        )

    @property
    def topic_name(self) -> str:
        """The fully qualified name after remapping."""
        self.use()
        return self.endpoint.endpoint.topic

    @property
    def logger_name(self) -> str:
        """The name of the node's logger."""
        return self._node.get_logger().name

    @property
    def is_cft_enabled(self) -> bool:
        """Whether a content filter is set."""
        self.use()
        return self._content_filter is not None

    def set_content_filter(self, filter_expression: str, expression_parameters: Sequence[str]) -> None:
        """Keep only messages for which the expression is true; an empty expression ends the filtering.

        Raises `RCLError` for an invalid expression, which leaves the filter as it was, and `TypeError`.
        """
        self.use()
        self._set_filter(ContentFilterOptions(filter_expression, list(expression_parameters)), "set")

    def get_content_filter(self) -> ContentFilterOptions:
        """Return the filter in effect; raises `RCLError` if there is none."""
        self.use()
        if self._content_filter is None:
            raise RCLError(
                "Failed to get cft expression parameters: this subscriber has not created a ContentFilteredTopic"
            )
        return self._content_filter

    def _set_filter(self, wanted: ContentFilterOptions, verb: str) -> None:
        from bot_console.runtime.rmw.content_filter import (
            MAX_PARAMETERS,
            ContentFilterError,
            FilteredQueue,
            compile_filter,
        )

        expression, parameters = wanted
        if not isinstance(expression, str) or not all(isinstance(each, str) for each in parameters):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's arguments
            raise TypeError(f"{verb}_content_filter(): the expression and its parameters must be str")
        if len(parameters) > MAX_PARAMETERS:
            raise RCLError(
                "Failed to init subscription content_filtered_topic option: "
                f"The maximum of expression parameters argument number is {MAX_PARAMETERS}"
            )
        if verb == "set" and not expression:
            if self._content_filter is None:
                raise RCLError(
                    "Failed to set cft expression parameters: current subscriber has no content filter topic"
                )
            self._content_filter = None
            self._use_queue(deque(self._queue, self._queue.maxlen))
            return
        try:
            accepts = compile_filter(expression, parameters, self.msg_type)
        except ContentFilterError as error:
            failed = "set cft expression parameters" if verb == "set" else "create subscription"
            raise RCLError(f"Failed to {failed}: the content filter '{expression}' is invalid: {error}") from None
        self._content_filter = wanted
        self._use_queue(FilteredQueue(self._queue, self._queue.maxlen, accepts, self.msg_type))

    def _use_queue(self, queue: deque[Arrival]) -> None:
        self._queue = self.endpoint.queue = queue

    def get_publisher_count(self) -> int:
        """Return the number of matched publishers."""
        self.use()
        return self.endpoint.matched

    def pending(self) -> bool:
        """Whether a message has arrived."""
        return bool(self._queue)

    def take(self) -> tuple[Any, dict[str, int | None]] | None:
        """Take the next unexpired message with its info, bypassing executors; None if there is none."""
        while self._queue:
            message, stamp, received, number, expires = self._queue.popleft()
            if expires is None or current().clock.system_ns() <= expires:
                taken = take_queued(message)
                if taken is not None:
                    return taken, _info(stamp, received, number)
        return None

    def run(self) -> object:
        """Take one message and run the callback."""
        try:
            message, stamp, received, number, expires = self._queue.popleft()
        except IndexError:  # another thread has taken it
            return None
        if self._queue:
            self.notify()  # in a reentrant group the next callback may begin before this one has ended
        if expires is not None and current().clock.system_ns() > expires:
            return None
        if isinstance(message, HeldMessage):  # inlined from `take_queued`, to save a call per message
            message = message.take()
            if message is None:
                return None
        result = (
            self._callback(message) if self._message_only else self._callback(message, _info(stamp, received, number))
        )
        return result if self._is_async else None

    def destroy(self) -> None:
        """Destroy the subscription."""
        for handler in self.event_handlers:
            handler.destroy()
        self.destroyed = True
        self._node._ros_bus.remove(self.endpoint)
        self._queue.clear()
        self.detach()

    def __enter__(self) -> Subscription:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.destroy()


def _info(stamp: int, received: int, number: int) -> dict[str, int | None]:
    return {
        "source_timestamp": stamp,
        "received_timestamp": received,
        "publication_sequence_number": number,
        "reception_sequence_number": None,
    }


__getattr__ = reexporting(__name__, "CallbackGroup EventHandler MsgType QoSProfile SubscriptionEventCallbacks")
