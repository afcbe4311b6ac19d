"""A transform buffer that queries another process, which runs `tf2_ros buffer_server`."""

from __future__ import annotations

import warnings
from typing import Any

from bot_console.runtime.process import current
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import TransformStamped
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from tf2_ros.buffer_interface import NOW, BufferInterface

PADDING = Duration(seconds=2)
"""How much longer than a lookup's own timeout the server may take to answer."""
MESSAGE_TIME = (
    "Passing a builtin_interfaces.msg.Time argument is deprecated, and will be removed in the near future. "
    "Use rclpy.time.Time instead."
)
ERRORS: dict[int, type[TransformException]] = {
    TF2Error.LOOKUP_ERROR: LookupException,
    TF2Error.CONNECTIVITY_ERROR: ConnectivityException,
    TF2Error.EXTRAPOLATION_ERROR: ExtrapolationException,
    TF2Error.INVALID_ARGUMENT_ERROR: InvalidArgumentException,
    TF2Error.TIMEOUT_ERROR: TimeoutException,
    TF2Error.TRANSFORM_ERROR: TransformException,
}


class BufferClient(BufferInterface):
    """Queries a server's action `ns`. The node must be spun in a thread other than the calling one.

    Lookups raise the server's exception, or `TimeoutException` if there is no server or it does not answer.
    """

    def __init__(self, node: Node, ns: str, check_frequency: float = 10.0, timeout_padding: Duration = PADDING) -> None:
        super().__init__()
        self.node = node
        self.action_client = ActionClient(node, LookupTransform, action_name=ns)
        self.check_frequency = check_frequency
        self.timeout_padding = timeout_padding

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Duration = NOW
    ) -> TransformStamped:
        """Return the transform that maps points from `source_frame` to `target_frame`; the server waits up to
        `timeout`.
        """
        if isinstance(time, TimeMessage):
            warnings.warn(MESSAGE_TIME, stacklevel=2)
        elif not isinstance(time, Time):
            raise TypeError("Must pass a rclpy.time.Time object.")
        goal = LookupTransform.Goal(target_frame=target_frame, source_frame=source_frame, advanced=False)
        goal.source_time, goal.timeout = _stamp(time), timeout.to_msg()
        return self._ask(goal)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NOW,
    ) -> TransformStamped:
        """Return the transform from `source_frame` at one time to `target_frame` at another, via a fixed frame."""
        goal = LookupTransform.Goal(target_frame=target_frame, source_frame=source_frame, advanced=True)
        goal.source_time, goal.timeout = _stamp(source_time), timeout.to_msg()
        goal.target_time, goal.fixed_frame = _stamp(target_time), fixed_frame
        return self._ask(goal)

    def can_transform(self, target_frame: str, source_frame: str, time: Time, timeout: Duration = NOW) -> bool:
        """Return whether `lookup_transform` succeeds within the timeout."""
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NOW,
    ) -> bool:
        """Return whether `lookup_transform_full` succeeds within the timeout."""
        try:
            self.lookup_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        except TransformException:
            return False
        return True

    def _ask(self, goal: Any) -> TransformStamped:
        if not self.action_client.server_is_ready():
            raise TimeoutException("The BufferServer is not ready.")
        timeout_ns = Duration.from_msg(goal.timeout).nanoseconds + self.timeout_padding.nanoseconds
        deadline = current().clock.steady_ns() + timeout_ns
        handle = _result_before(self.action_client.send_goal_async(goal), deadline)
        if not handle.accepted:
            raise TimeoutException("The BufferServer has not accepted the goal.")
        result = _result_before(handle.get_result_async(), deadline).result
        error = result.error
        if error.error != TF2Error.NO_ERROR:
            raise ERRORS.get(error.error, TransformException)(error.error_string)
        return result.transform


def _result_before(future: Future[Any], deadline: int) -> Any:
    """Return the result of a future; raises `TimeoutException` at a steady time (ns)."""
    wakeup = current().clock.wakeup()
    future.add_done_callback(lambda _: wakeup.set())
    if not future.done():
        wakeup.wait(deadline)
    if not future.done():
        raise TimeoutException("The BufferServer has not answered in time: it hangs, or nobody spins this node.")
    return future.result()


def _stamp(time: object) -> Any:
    """Return a time as a message; it may already be one."""
    return time.to_msg() if isinstance(time, Time) else time
