"""Nodes `fibonacci_action_server`: compute one more number of the sequence each second."""

from __future__ import annotations

import time
from typing import Any

from action_tutorials_interfaces.action import Fibonacci
from bot_console_demos.running import run
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.node import Node
from rclpy.task import Future


class PythonServer(Node):
    """Behaves like the Python tutorial's server: computes the sequence in the callback, which sleeps."""

    def __init__(self) -> None:
        super().__init__("fibonacci_action_server")
        self._server = ActionServer(self, Fibonacci, "fibonacci", self._execute)

    def _execute(self, goal: Any) -> Fibonacci.Result:
        self.get_logger().info("Executing goal...")
        feedback = Fibonacci.Feedback(partial_sequence=[0, 1])
        for at in range(1, goal.request.order):
            feedback.partial_sequence.append(feedback.partial_sequence[at] + feedback.partial_sequence[at - 1])
            self.get_logger().info(f"Feedback: {feedback.partial_sequence}")
            goal.publish_feedback(feedback)
            time.sleep(1)
        goal.succeed()
        return Fibonacci.Result(sequence=feedback.partial_sequence)


class CppServer(Node):
    """Behaves like the C++ tutorial's server: goals run concurrently and can be cancelled."""

    def __init__(self) -> None:
        super().__init__("fibonacci_action_server")
        self._server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            self._execute,
            goal_callback=self._on_goal,
            cancel_callback=self._on_cancel,
        )

    def _on_goal(self, request: Fibonacci.Goal) -> GoalResponse:
        self.get_logger().info(f"Received goal request with order {request.order}")
        return GoalResponse.ACCEPT

    def _on_cancel(self, _: Any) -> CancelResponse:
        self.get_logger().info("Received request to cancel goal")
        return CancelResponse.ACCEPT

    async def _execute(self, goal: Any) -> Fibonacci.Result:
        self.get_logger().info("Executing goal")
        sequence = [0, 1]
        for _ in range(1, goal.request.order):
            if goal.is_cancel_requested:
                goal.canceled()
                self.get_logger().info("Goal canceled")
                return Fibonacci.Result(sequence=sequence)
            sequence.append(sequence[-1] + sequence[-2])
            goal.publish_feedback(Fibonacci.Feedback(partial_sequence=sequence))
            self.get_logger().info("Publish feedback")
            await self._second()
        goal.succeed()
        self.get_logger().info("Goal succeeded")
        return Fibonacci.Result(sequence=sequence)

    async def _second(self) -> None:
        """Wait for a second without blocking the executor."""
        done: Future[None] = Future()
        timer = self.create_timer(1.0, lambda: done.set_result(None) if not done.done() else None)
        try:
            await done
        finally:
            self.destroy_timer(timer)


def main_py(args: list[str] | None = None) -> None:
    """Entry point of `action_tutorials_py`."""
    run(PythonServer, args)


def main_cpp(args: list[str] | None = None) -> None:
    """Entry point of `action_tutorials_cpp`."""
    run(CppServer, args)
