"""Sends goals to actions for a user, and keeps their feedback and results."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from bot_console.tui.console.topics.forms import filled, stamp
from bot_console.tui.console.topics.interfaces import interface
from bot_console.tui.console.topics.message_tree import tree
from bot_console.tui.console.topics.port import Field, Goal, Payload, Values
from rclpy.action import ActionClient
from rclpy.node import Node

STATUS = {4: "succeeded", 5: "canceled", 6: "aborted"}


@dataclass
class _SentGoal:
    """A goal that was sent."""

    type: str
    began: float
    goal: Goal
    handle: Any = None
    feedback: Any = None
    """The newest feedback message; converted to lines on demand."""
    shown: int = 0
    lines: tuple[Field, ...] = ()


class Goals:
    """The last goal sent to each action; `send` and `cancel` must be called in the executor's thread."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[tuple[str, str], Any] = {}
        self._sent: dict[str, _SentGoal] = {}

    def send(self, action: str, type_name: str, values: Values) -> None:
        """Send a goal; raises `ValueError` if it cannot be filled in."""
        goal, now = filled(Payload.GOAL, type_name, values)
        kind = interface(Payload.GOAL, type_name)
        key = action, type_name
        client = self._clients.get(key)
        if client is None:
            client = self._clients[key] = ActionClient(self._node, kind, action)
        stamp(goal, now, lambda: self._node.get_clock().now().to_msg())
        sent = self._sent[action] = _SentGoal(type_name, time.monotonic(), Goal(action, "sent"))
        self._when_ready(client, goal, sent)

    def _when_ready(self, client: Any, goal: Any, sent: _SentGoal, polls: int = 40) -> None:
        """Send the goal once its client has discovered the server; after `polls` polls, fail."""
        if client.server_is_ready():
            answer = client.send_goal_async(goal, feedback_callback=partial(self._feedback, sent))
            answer.add_done_callback(partial(self._accepted, sent))
            return
        left = [polls]

        def poll() -> None:
            left[0] -= 1
            if client.server_is_ready() or left[0] <= 0:
                self._node.destroy_timer(timer)
                if client.server_is_ready():
                    self._when_ready(client, goal, sent, 0)
                else:
                    self._end(
                        sent, "not sent", problem=f"no server of {sent.goal.action} responds; has its node ended?"
                    )

        timer = self._node.create_timer(0.05, poll)

    def _feedback(self, sent: _SentGoal, message: Any) -> None:
        sent.feedback = message.feedback
        sent.goal = replace(sent.goal, feedback_count=sent.goal.feedback_count + 1)

    def _accepted(self, sent: _SentGoal, done: Any) -> None:
        handle = done.result()
        if handle is None or not handle.accepted:
            self._end(sent, "rejected")
            return
        sent.handle = handle
        sent.goal = replace(sent.goal, status="executing")
        handle.get_result_async().add_done_callback(partial(self._result, sent))

    def _result(self, sent: _SentGoal, done: Any) -> None:
        answer = done.result()
        if answer is None:
            self._end(sent, "lost", problem="the server has ended")
            return
        lines = tree(answer.result, f"{sent.type}_Result")
        self._end(sent, STATUS.get(answer.status, f"status {answer.status}"), result=lines)

    @staticmethod
    def _end(sent: _SentGoal, status: str, **more: Any) -> None:
        sent.goal = replace(sent.goal, status=status, active=False, seconds=time.monotonic() - sent.began, **more)

    def why_not_cancel(self, action: str) -> str:
        """Why the last goal cannot be cancelled; empty if it can."""
        sent = self._sent.get(action)
        if sent is None or not sent.goal.active:
            return f"no goal of {action} that was sent from here is running"
        return "" if sent.handle is not None else f"{action} has not accepted the goal yet"

    def cancel(self, action: str) -> None:
        """Request cancellation of the last goal."""
        sent = self._sent[action]
        if not sent.goal.active:
            return  # the goal has ended in the meantime
        sent.goal = replace(sent.goal, status="cancelling")
        sent.handle.cancel_goal_async().add_done_callback(partial(self._cancelled, sent))

    @staticmethod
    def _cancelled(sent: _SentGoal, done: Any) -> None:
        answer = done.result()
        if sent.goal.active and (answer is None or not answer.goals_canceling):
            sent.goal = replace(sent.goal, status="executing", problem="the server refuses to cancel it")

    def goals(self) -> Mapping[str, Goal]:
        """The last goal of each action; from any thread."""
        now = time.monotonic()
        for sent in list(self._sent.values()):
            if sent.shown != sent.goal.feedback_count:
                sent.shown = sent.goal.feedback_count
                sent.lines = tree(sent.feedback, f"{sent.type}_Feedback")
        return {
            action: replace(
                sent.goal, feedback=sent.lines, seconds=now - sent.began if sent.goal.active else sent.goal.seconds
            )
            for action, sent in list(self._sent.items())
        }

    def close(self) -> None:
        """Destroy all clients."""
        for client in self._clients.values():
            client.destroy()
        self._clients.clear()
