"""Program `buffer_server`: looks up transforms for other processes, through the action `tf2_buffer_server`."""

from __future__ import annotations

import threading
from typing import Any

from bot_console_demos.running import run
from rclpy.action import ActionServer, CancelResponse
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from tf2_ros import (
    Buffer,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
    TransformListener,
)

CHECK_PERIOD_S = 0.01
"""Interval, in s, at which pending goals are checked."""
ERRORS: dict[type[TransformException], int] = {
    LookupException: TF2Error.LOOKUP_ERROR,
    ConnectivityException: TF2Error.CONNECTIVITY_ERROR,
    ExtrapolationException: TF2Error.EXTRAPOLATION_ERROR,
    InvalidArgumentException: TF2Error.INVALID_ARGUMENT_ERROR,
    TimeoutException: TF2Error.TIMEOUT_ERROR,
}


class BufferServer(Node):
    """Answers a goal as soon as its transform is available, or with the reason when its time is up."""

    def __init__(self) -> None:
        super().__init__("tf_buffer")
        size = float(self.declare_parameter("buffer_size", 120.0).value)
        self._buffer = Buffer(Duration(seconds=size))
        self._listener = TransformListener(self._buffer, self)
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._waiting: list[tuple[Any, int]] = []
        self._lock = threading.Lock()
        self._server = ActionServer(
            self,
            LookupTransform,
            "tf2_buffer_server",
            self._execute,
            handle_accepted_callback=self._accepted,
            cancel_callback=_accept,
        )
        self.create_timer(CHECK_PERIOD_S, self._check, clock=self._steady)

    def _accepted(self, goal: Any) -> None:
        timeout_ns = Duration.from_msg(goal.request.timeout).nanoseconds
        if timeout_ns <= 0 or self._can(goal.request):
            goal.execute()
            return
        with self._lock:
            self._waiting.append((goal, self._steady.now().nanoseconds + timeout_ns))

    def _check(self) -> None:
        now = self._steady.now().nanoseconds
        with self._lock:
            due = [goal for goal, end in self._waiting if self._is_due(goal, end, now)]
            self._waiting = [each for each in self._waiting if each[0] not in due]
        for goal in due:
            goal.execute()

    def _is_due(self, goal: Any, end: int, now: int) -> bool:
        return now >= end or goal.is_cancel_requested or self._can(goal.request)

    def _can(self, asked: Any) -> bool:
        if not asked.advanced:
            return bool(
                self._buffer.can_transform(asked.target_frame, asked.source_frame, Time.from_msg(asked.source_time))
            )
        return bool(
            self._buffer.can_transform_full(
                asked.target_frame,
                Time.from_msg(asked.target_time),
                asked.source_frame,
                Time.from_msg(asked.source_time),
                asked.fixed_frame,
            )
        )

    def _execute(self, goal: Any) -> LookupTransform.Result:
        result = LookupTransform.Result()
        if goal.is_cancel_requested:
            goal.canceled()
            return result
        try:
            result.transform = self._look_up(goal.request)
        except TransformException as error:
            result.error.error = ERRORS.get(type(error), TF2Error.TRANSFORM_ERROR)
            result.error.error_string = str(error)
            goal.abort()
        else:
            goal.succeed()
        return result

    def _look_up(self, asked: Any) -> Any:
        if not asked.advanced:
            return self._buffer.lookup_transform(
                asked.target_frame, asked.source_frame, Time.from_msg(asked.source_time)
            )
        return self._buffer.lookup_transform_full(
            asked.target_frame,
            Time.from_msg(asked.target_time),
            asked.source_frame,
            Time.from_msg(asked.source_time),
            asked.fixed_frame,
        )


def _accept(_: Any) -> CancelResponse:
    return CancelResponse.ACCEPT


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(BufferServer, args)
