"""Timers and rates."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from bot_console.runtime.process import current
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.callback_groups import CallbackGroup
from rclpy.clock_type import ClockType
from rclpy.deadlock import WARNING_DELAY_NS, report_deadlock
from rclpy.exceptions import ROSInterruptException
from rclpy.impl.callback_order import TIMER
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import Entity
from rclpy.impl.reexports import reexporting

if TYPE_CHECKING:
    from rclpy.clock import Clock
    from rclpy.context import Context
    from rclpy.impl.entity import EntityExecutor
    from rclpy.node_parts.base import NodeBase


MAX_PERIOD_NS = 2**63 - 1


def _checked_period(period_ns: int) -> int:
    """Return the period, which must fit into 64 bits as upstream; raises `TypeError`."""
    if not -MAX_PERIOD_NS - 1 <= period_ns <= MAX_PERIOD_NS:
        raise TypeError(f"the period of a timer must be at most 2^63 - 1 ns (292 years), not {period_ns} ns")
    return period_ns


class Timer(Entity):
    """Calls back every period of its clock (ns); missed periods are skipped and the phase is kept."""

    KIND = TIMER
    arms_itself = True

    def __init__(
        self,
        callback: Callable[..., object] | None,
        callback_group: CallbackGroup,
        timer_period_ns: int,
        clock: Clock,
        *,
        context: Context | None = None,
        autostart: bool = True,
    ) -> None:
        super().__init__(callback_group)
        if not hasattr(autostart, "__bool__"):  # upstream's C++ also converts numbers and None
            raise TypeError(f"autostart must be a bool, not {type(autostart).__name__}")
        if _checked_period(timer_period_ns) < 0:
            raise RCLError("failed to create timer: timer period must be non-negative")
        self.callback = callback
        self.clock_of_timer = clock
        self._context = context
        self._period = timer_period_ns
        self._now = clock._reader()
        self._is_steady = clock.clock_type is ClockType.STEADY_TIME
        self._last = self._now()
        self._next = self._last + timer_period_ns
        self._canceled = not autostart
        clock._add_timer(self)

    @property
    def handle(self) -> Destroyable:
        """The timer's handle, as upstream has one."""
        return Destroyable(self, self.use)

    @property
    def clock(self) -> Clock:
        """The clock that drives the timer."""
        return self.clock_of_timer

    @property
    def timer_period_ns(self) -> int:
        """The period in ns; a new one takes effect with the next call."""
        self.use()
        return self._period

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self.use()
        self._period = _checked_period(int(value))

    def pending(self) -> bool:
        """Whether the timer is due."""
        return not self._canceled and not self.destroyed and self._now() >= self._next

    def is_ready(self) -> bool:
        """Whether the timer is due."""
        self.use()
        return self.pending()

    def is_canceled(self) -> bool:
        """Whether the timer was cancelled and has not been reset since."""
        self.use()
        return self._canceled

    def cancel(self) -> None:
        """Stop calling back until `reset`."""
        self.use()
        self._canceled = True

    def reset(self) -> None:
        """Restart the timer: the next call is one period from now."""
        self.use()
        self._next = self.clock_of_timer._now_ns() + self._period
        self._canceled = False
        self.arm()

    def time_since_last_call(self) -> int:
        """Return the nanoseconds since the last call, or since the timer was created."""
        self.use()
        return self.clock_of_timer._now_ns() - self._last

    def time_until_next_call(self) -> int | None:
        """Return the nanoseconds until the next call, negative when it is overdue, None while cancelled."""
        self.use()
        return None if self._canceled else self._next - self.clock_of_timer._now_ns()

    def attach(self, sink: EntityExecutor, node_order: int) -> None:
        """Attach the timer to an executor."""
        self._belong(sink, node_order)
        self.arm()  # without `notify`, which would run it twice in one wake

    def arm(self) -> None:
        """Report to the executor when the timer is due; called again at each jump of simulated time."""
        sink = self.sink
        if sink is None or self._canceled or self.destroyed:
            return
        deadline = self.clock_of_timer._steady_deadline(self._next)
        if deadline is not None:
            sink.arm(self, deadline)
        elif self.pending():
            self.notify()

    def time_jumped(self, backward: bool) -> None:
        """Re-arm after a jump of the clock; after a jump back the next call is one period later."""
        if backward:
            now = self.clock_of_timer._now_ns()
            self._last = now
            self._next = now + self._period
        self.arm()

    def run(self) -> object:
        """Run the callback, and set the time of the next call."""
        self._last = now = self._now()
        period = self._period
        due = self._next + period
        if due <= now:
            due = now if period == 0 else due + ((now - due) // period + 1) * period
        self._next = due
        if self._is_steady and self.sink is not None and not self._canceled:
            self.sink.arm(self, due)  # inlined from `arm`
        else:
            self.arm()
        result = self._callback() if self._callback is not None else None
        return result if self._is_async else None

    def destroy(self) -> None:
        """Destroy the timer; every later use raises `InvalidHandle`."""
        self.destroyed = True
        self.clock_of_timer._remove_timer(self)
        self.detach()


class Rate:
    """Sleeps at a frequency; created by `Node.create_rate`."""

    def __init__(self, timer: Timer, *, node: NodeBase) -> None:
        context = node.context
        self._timer = timer
        self._node = node
        self._clock = timer.clock
        self._wakeup = current().clock.wakeup()
        self._lock = threading.Lock()
        self._is_shutdown = False
        self._is_destroyed = False
        self._sleepers = 0
        timer.callback = self._tick
        context.on_end(self._shutdown)

    def _tick(self) -> None:
        self._wakeup.set()

    def _shutdown(self) -> None:
        self._is_shutdown = True
        self.destroy()

    def destroy(self) -> None:
        """Destroy the rate, which wakes the threads that sleep in it."""
        self._is_destroyed = True
        self._wakeup.set()

    def _presleep(self) -> None:
        if self._is_shutdown:
            raise ROSInterruptException
        if self._is_destroyed:
            raise RuntimeError("Rate cannot sleep because it has been destroyed")
        if self._timer.destroyed:
            raise InvalidHandle("Rate cannot sleep because the timer has been destroyed")
        with self._lock:
            self._sleepers += 1

    def _postsleep(self) -> None:
        with self._lock:
            self._sleepers -= 1
            if not self._sleepers:
                self._wakeup.clear()

    def sleep(self) -> None:
        """Block until the next tick; returns at once if there was one since the last sleep.

        Raises `ROSInterruptException` if ROS is shut down meanwhile; returns if the rate is destroyed.
        """
        self._presleep()
        try:
            if not self._wakeup.wait(current().clock.steady_ns() + WARNING_DELAY_NS):
                report_deadlock(self._timer, self._node, "sleep() of a rate")
                self._wakeup.wait()
        finally:
            self._postsleep()
        if self._is_shutdown:
            current().deliver_signals()  # Ctrl-C also ends the context: the sleeper should see `KeyboardInterrupt`
            raise ROSInterruptException


__getattr__ = reexporting(__name__, "Clock Context get_default_context")
