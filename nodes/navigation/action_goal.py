"""An action goal shared between its server, which awaits it, and the control loop, which executes it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bot_console_robot.navigation.goal_motion import Task
from builtin_interfaces.msg import Duration
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future

if TYPE_CHECKING:
    from rclpy.action.server import ServerGoalHandle

FEEDBACK_PERIOD_S = 0.2
"""Interval between feedback messages, in s."""
PREEMPTED = 1
"""Error code of a goal that was replaced by another one."""


class Goal:
    """A task, with the action goal it belongs to, if any."""

    def __init__(self, task: Task, handle: ServerGoalHandle | None = None) -> None:
        self.task = task
        self.preempted = False
        self.done: Future[int] = Future()
        self._handle = handle
        self._began = Clock(clock_type=ClockType.STEADY_TIME).now().nanoseconds * 1e-9

    @property
    def cancelled(self) -> bool:
        """Whether cancellation was requested."""
        return self._handle is not None and self._handle.is_cancel_requested

    def age(self, now: float) -> float:
        """Return the seconds since the goal started."""
        return now - self._began

    def duration(self, now: float) -> Duration:
        """Return the age as a message."""
        seconds, rest = divmod(int(max(0.0, self.age(now)) * 1e9), 1_000_000_000)
        return Duration(sec=seconds, nanosec=rest)

    def finish(self) -> None:
        """Wake the coroutine that awaits the goal."""
        if not self.done.done():
            self.done.set_result(PREEMPTED if self.preempted else self.task.error_code)

    def settle(self) -> None:
        """Report the outcome to the action server."""
        if self._handle is None:
            return
        if self.cancelled and not self.preempted:
            self._handle.canceled()
        elif self.preempted or self.task.error_code:
            self._handle.abort()
        else:
            self._handle.succeed()

    def report(self, message: Any) -> None:
        """Publish feedback while the goal is active."""
        if self._handle is not None and not self.done.done():
            self._handle.publish_feedback(message)


async def run_goal(node: Node, goal: Goal, fill: Callable[[], None], message: Any) -> int:
    """Await a goal, publishing feedback meanwhile; returns its error code. `fill` completes the feedback message."""

    def report() -> None:
        fill()
        goal.report(message)

    timer = node.create_timer(FEEDBACK_PERIOD_S, report, clock=Clock(clock_type=ClockType.STEADY_TIME))
    try:
        code = await goal.done
    finally:
        node.destroy_timer(timer)
    goal.settle()
    return code or 0
