"""A transform buffer in this process, with timeouts, futures and coroutines."""

from __future__ import annotations

import threading
import time as wall
from collections.abc import Callable

from geometry_msgs.msg import TransformStamped
from rclpy.clock import Clock, ClockChange, JumpHandle, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from tf2_msgs.srv import FrameGraph
from tf2_py import BufferCore, TransformException
from tf2_ros.buffer_interface import NOW, BufferInterface

TRANSFORM_POLL_S = 0.02
"""How often (s) a waiting call polls, as upstream."""


class Buffer(BufferCore, BufferInterface):
    """Keeps transforms and answers lookups; with a node it also offers the service `tf2_frames`.

    When the clock of the node, or of the listener that fills the buffer, jumps back or changes its source, all
    transforms except static ones are forgotten. Lookups raise `LookupException`, `ConnectivityException`,
    `ExtrapolationException`, `InvalidArgumentException`.
    """

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._new_data_callbacks: list[Callable[[], None]] = []
        self._callbacks_to_remove: list[Callable[[], None]] = []
        self._callbacks_lock = threading.RLock()
        self._jump_handle: JumpHandle | None = None
        if node is not None:
            self.follow_clock(node)
            self.srv = node.create_service(FrameGraph, "tf2_frames", self.__get_frames)

    def follow_clock(self, node: Node) -> None:
        """Forget transforms when the node's clock jumps back; only the first node is followed."""
        if self._jump_handle is None:
            threshold = JumpThreshold(min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True)
            clock = node.get_clock()
            self._jump_handle = clock.create_jump_callback(threshold, post_callback=self.time_jump_callback)

    def time_jump_callback(self, time_jump: TimeJump) -> None:
        """Forget all transforms that are not static, as they belong to another time."""
        changed = time_jump.clock_change is not ClockChange.ROS_TIME_NO_CHANGE
        what = "time source change" if changed else "jump back in time"
        get_logger("tf2_buffer").warning(f"Detected {what}. Clearing tf buffer.")
        self.clear()

    def __get_frames(self, request: FrameGraph.Request, response: FrameGraph.Response) -> FrameGraph.Response:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform, and notify the waiting callers."""
        super().set_transform(transform, authority)
        self._call_new_data_callbacks()

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform that is valid at any time, and notify the waiting callers."""
        super().set_transform_static(transform, authority)
        self._call_new_data_callbacks()

    def take_messages(self, transforms: list[TransformStamped]) -> None:
        """Add transforms that nobody else holds, such as those of a received message."""
        self._take_later(transforms)
        self._call_new_data_callbacks()

    def _call_new_data_callbacks(self) -> None:
        if not self._new_data_callbacks:
            return
        with self._callbacks_lock:
            for callback in list(self._new_data_callbacks):
                callback()
            for callback in self._callbacks_to_remove:
                self._new_data_callbacks.remove(callback)
            self._callbacks_to_remove.clear()

    def _remove_callback(self, callback: Callable[[], None]) -> None:
        with self._callbacks_lock:
            if callback in self._new_data_callbacks and callback not in self._callbacks_to_remove:
                self._callbacks_to_remove.append(callback)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Duration = NOW
    ) -> TransformStamped:
        """Return the transform that maps points from `source_frame` to `target_frame`; waits up to `timeout`."""
        if timeout is not NOW and timeout != NOW:
            self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Time) -> TransformStamped:
        """Return the transform of `lookup_transform` in a coroutine, which waits without a limit."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

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
        if timeout != NOW:
            self.can_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        return self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)

    async def lookup_transform_full_async(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> TransformStamped:
        """Return the transform of `lookup_transform_full` in a coroutine, which waits without a limit."""
        await self.wait_for_transform_full_async(target_frame, target_time, source_frame, source_time, fixed_frame)
        return self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = NOW,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """Return whether `lookup_transform` would succeed within the timeout, as 1 or 0; with the reason on request."""
        answer = _poll_until_possible(lambda: self.can_transform_core(target_frame, source_frame, time), timeout)
        return answer if return_debug_tuple else answer[0]

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NOW,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """Return whether `lookup_transform_full` would succeed within the timeout."""
        answer = _poll_until_possible(
            lambda: self.can_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame),
            timeout,
        )
        return answer if return_debug_tuple else answer[0]

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Time) -> Future[TransformStamped]:
        """Return a future for the transform, which is done when the transform is known."""
        return self._when(
            lambda: self.can_transform_core(target_frame, source_frame, time),
            lambda: self.lookup_transform_core(target_frame, source_frame, time),
        )

    def wait_for_transform_full_async(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> Future[TransformStamped]:
        """Return a future for the transform between two times, which is done when the transform is known."""
        arguments = target_frame, target_time, source_frame, source_time, fixed_frame
        return self._when(
            lambda: self.can_transform_full_core(*arguments), lambda: self.lookup_transform_full_core(*arguments)
        )

    def _when(
        self, ask: Callable[[], tuple[int, str]], look_up: Callable[[], TransformStamped]
    ) -> Future[TransformStamped]:
        future: Future[TransformStamped] = Future()
        if ask()[0]:
            future.set_result(look_up())
            return future

        def poll_again() -> None:
            try:
                if not future.done() and ask()[0]:
                    future.set_result(look_up())
            except TransformException as error:
                future.set_exception(error)

        with self._callbacks_lock:
            self._new_data_callbacks.append(poll_again)
        future.add_done_callback(lambda _: self._remove_callback(poll_again))
        return future


def _poll_until_possible(ask: Callable[[], tuple[int, str]], timeout: Duration) -> tuple[int, str]:
    """Poll until the answer is positive or the time has expired; return the last answer."""
    answer = ask()
    if not answer[0] and timeout != NOW:
        clock = Clock()
        deadline = clock.now() + timeout
        while not answer[0] and clock.now() < deadline:
            wall.sleep(TRANSFORM_POLL_S)
            answer = ask()
    return answer
