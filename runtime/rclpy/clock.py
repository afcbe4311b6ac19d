"""Clocks: system, steady, and ROS time, which `/clock` may drive."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable
from enum import IntEnum
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol

from bot_console.runtime.process import current
from rclpy.clock_type import ClockType, TimeClockType
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.impl.any_clock import AnyClock
from rclpy.impl.reexports import reexporting
from rclpy.time import Time
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from rclpy.context import Context

__all__ = [
    "Clock",
    "ClockChange",
    "ClockType",
    "JumpHandle",
    "JumpThreshold",
    "ROSClock",
    "TimeJump",
]


class ClockChange(IntEnum):
    """How the source of ROS time changed at a jump."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class JumpThreshold:
    """The jumps for which a callback is called: at least `min_forward` ahead, or at least `min_backward` back."""

    def __init__(
        self, *, min_forward: Duration | None, min_backward: Duration | None, on_clock_change: bool = True
    ) -> None:
        if min_forward is not None and min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if min_backward is not None and min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        if min_forward is None and min_backward is None and not on_clock_change:
            raise ValueError("At least one jump threshold must be enabled")
        self.min_forward = min_forward
        self.min_backward = min_backward
        self.on_clock_change = on_clock_change


class TimeJump:
    """A jump: how the source changed, and how far time moved."""

    def __init__(self, clock_change: ClockChange, delta: Duration) -> None:
        if not isinstance(clock_change, ClockChange):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise TypeError("clock_change must be an instance of rclpy.clock.ClockChange")
        self._clock_change = clock_change
        self._delta = delta

    @property
    def clock_change(self) -> ClockChange:
        """How the source changed."""
        return self._clock_change

    @property
    def delta(self) -> Duration:
        """How far time moved."""
        return self._delta


class ClockUser(Protocol):
    """Something that waits for a point in time of a clock."""

    def arm(self) -> None:
        """Set again when it is due, with its executor."""

    def time_jumped(self, backward: bool) -> None:
        """Handle a jump of the clock."""


class JumpHandle:
    """Callbacks before and after jumps, until `unregister` is called."""

    def __init__(
        self,
        clock: Clock,
        threshold: JumpThreshold,
        pre_callback: Callable[[], object] | None,
        post_callback: Callable[[TimeJump], object] | None,
    ) -> None:
        self._clock = clock
        self.threshold = threshold
        self.pre_callback = pre_callback
        self.post_callback = post_callback
        clock._jump_handles.append(self)

    def unregister(self) -> None:
        """Remove the callbacks."""
        if self._clock is not None:
            self._clock._jump_handles.remove(self)
            self._clock = None

    def __enter__(self) -> JumpHandle:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.unregister()


class Clock(AnyClock):
    """A clock; `ROSClock` is the class of those of type ROS_TIME."""

    def __new__(cls, *, clock_type: ClockType | TimeClockType = ClockType.SYSTEM_TIME) -> Clock:
        """Choose the class by the type."""
        if isinstance(clock_type, TimeClockType):
            clock_type = ClockType(clock_type)
        if not isinstance(clock_type, ClockType):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise TypeError("Clock type must be a ClockType enum")
        kind: Any = ROSClock if clock_type is ClockType.ROS_TIME else cls
        return super().__new__(kind)

    def __init__(self, *, clock_type: ClockType | TimeClockType = ClockType.SYSTEM_TIME) -> None:
        self._clock_type = ClockType(clock_type)
        self._source = current().clock
        # Chosen once: a timer reads its clock several times per call.
        self._read = self._source.steady_ns if self._clock_type is ClockType.STEADY_TIME else self._source.system_ns
        self._jump_handles: list[JumpHandle] = []
        self._timers: weakref.WeakSet[ClockUser] = weakref.WeakSet()
        self._lock = threading.Lock()

    @property
    def clock_type(self) -> ClockType:
        """The kind of time that the clock measures."""
        return self._clock_type

    @property
    def handle(self) -> Clock:
        """The object wrapped by upstream's clock: here the clock itself."""
        return self

    def __repr__(self) -> str:
        return f"Clock(clock_type={self._clock_type.name})"

    def now(self) -> Time:
        """Return the current time."""
        return Time._of(self._now_ns(), self._clock_type)

    def _now_ns(self) -> int:
        return self._read()

    def _reader(self) -> Callable[[], int]:
        """Return the function behind `_now_ns`, for frequent callers."""
        return self._read

    def _steady_deadline(self, when: int) -> int | None:
        """Return the steady time (ns) at which this clock shows `when`; None if something else drives the clock."""
        if self._clock_type is ClockType.STEADY_TIME:
            return when
        # In this order, a thread that is preempted between the two readings wakes late, but never early.
        until = when - self._source.system_ns()
        return self._source.steady_ns() + until

    def _add_timer(self, timer: ClockUser) -> None:
        self._timers.add(timer)

    def _remove_timer(self, timer: ClockUser) -> None:
        self._timers.discard(timer)

    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Callable[[], object] | None = None,
        post_callback: Callable[[TimeJump], object] | None = None,
    ) -> JumpHandle:
        """Register callbacks before and after jumps beyond a threshold.

        Raises `ValueError` if neither is callable, `AttributeError` if `threshold` is not a threshold. As upstream, a
        `post_callback` that is not callable counts as missing.
        """
        if not callable(post_callback):
            post_callback = None
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        if pre_callback is not None and not callable(pre_callback):  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
            raise ValueError("pre_callback must be callable if given")
        _ = threshold.min_forward  # an invalid threshold fails now, not at a jump
        return JumpHandle(self, threshold, pre_callback, post_callback)

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Block until a time of this clock; False if the context was shut down or the clock jumped back meanwhile."""
        context = get_default_context() if context is None else context
        if not context.ok():
            raise NotInitializedException
        if until._clock_type != self._clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        wakeup = self._source.wakeup()
        forget = context.on_end(wakeup.set)
        changed: list[bool] = []

        def jumped(jump: TimeJump) -> None:
            if jump.clock_change in (ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED):
                changed.append(True)
            wakeup.set()

        threshold = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=None, on_clock_change=True)
        with self.create_jump_callback(threshold, post_callback=jumped):
            while context.ok() and not changed and self._now_ns() < until.nanoseconds:
                wakeup.clear()
                if context.ok() and self._now_ns() < until.nanoseconds:
                    wakeup.wait(self._steady_deadline(until.nanoseconds))
        forget()
        return bool(context.ok()) and not changed

    def sleep_for(self, rel_time: Duration, context: Context | None = None) -> bool:
        """Block for a duration of this clock."""
        return self.sleep_until(self.now() + rel_time, context)


class ROSClock(Clock):
    """ROS time: system time, unless a time source drives it."""

    def __new__(cls, *, clock_type: ClockType = ClockType.ROS_TIME) -> ROSClock:
        """Always this class."""
        return object.__new__(cls)

    def __init__(self, *, clock_type: ClockType = ClockType.ROS_TIME) -> None:
        super().__init__(clock_type=ClockType.ROS_TIME)
        self._active = False
        self._ros_time = 0

    @property
    def ros_time_is_active(self) -> bool:
        """Whether a time source drives the clock."""
        return self._active

    def _now_ns(self) -> int:
        return self._ros_time if self._active else self._read()

    def _reader(self) -> Callable[[], int]:
        return self._now_ns

    def _steady_deadline(self, when: int) -> int | None:
        return None if self._active else super()._steady_deadline(when)

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        if enabled == self._active:
            return
        change = ClockChange.ROS_TIME_ACTIVATED if enabled else ClockChange.ROS_TIME_DEACTIVATED

        def switch() -> None:
            self._active = enabled

        # rcl reports a change of source with a delta of zero, however much the two times differ.
        self._jump(TimeJump(change, Duration()), switch)
        for timer in list(self._timers):
            timer.time_jumped(True)

    def set_ros_time_override(self, time: Time) -> None:
        """Set the time that the clock shows while a time source drives it."""
        if not isinstance(time, Time):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise TypeError(f"Time must be specified as rclpy.time.Time. Received type: {type(time)}")
        before, after = self._ros_time, time.nanoseconds

        def switch() -> None:
            self._ros_time = after

        if not self._active:
            switch()
            return
        self._jump(TimeJump(ClockChange.ROS_TIME_NO_CHANGE, Duration(nanoseconds=after - before)), switch)
        for timer in list(self._timers):
            timer.time_jumped(after < before)

    def _jump(self, jump: TimeJump, switch: Callable[[], None]) -> None:
        reported = [each for each in self._jump_handles if _reports(each.threshold, jump)]
        for each in reported:
            if each.pre_callback is not None:
                each.pre_callback()
        switch()
        for each in reported:
            if each.post_callback is not None:
                each.post_callback(jump)


def _reports(threshold: JumpThreshold, jump: TimeJump) -> bool:
    if jump.clock_change in (ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED):
        return threshold.on_clock_change
    delta = jump.delta.nanoseconds
    forward, backward = threshold.min_forward, threshold.min_backward
    if delta > 0:
        return forward is not None and delta >= forward.nanoseconds
    return backward is not None and delta <= backward.nanoseconds


__getattr__ = reexporting(__name__, "Context")
