"""Follows the states of lifecycle nodes, and requests transitions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.graph.lifecycle_states import GET_STATE
from bot_console.tui.console.model import GraphInfo
from lifecycle_msgs.msg import TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState
from rclpy.node import Node

TRANSITION_TIMEOUT_S = 60.0
"""Seconds that a transition may take: drivers open their devices in it."""


class LifecycleWatch:
    """Asks each lifecycle node for its state once, then listens to its transitions.

    `changed` receives the states by node. All methods are called by the executor's thread.
    """

    def __init__(self, node: Node, calls: Calls, changed: Callable[[Mapping[str, str]], None]) -> None:
        self._node = node
        self._calls = calls
        self._changed = changed
        self._subscriptions: dict[str, Any] = {}
        self._states: dict[str, str] = {}

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph."""
        there = set(_lifecycle_nodes(graph))
        for name in self._subscriptions.keys() - there:
            self._node.destroy_subscription(self._subscriptions.pop(name))
            if self._states.pop(name, None) is not None:
                self._changed(dict(self._states))
        for name in sorted(there - self._subscriptions.keys()):
            heard = partial(self._heard, name)
            self._subscriptions[name] = self._node.create_subscription(
                TransitionEvent, f"{name}/transition_event", heard, 10
            )
            self._calls.run(partial(self._ask, name))

    def _heard(self, name: str, event: TransitionEvent) -> None:
        self._set(name, event.goal_state.label)

    def _set(self, name: str, state: str) -> None:
        if name in self._subscriptions and self._states.get(name) != state:
            self._states[name] = state
            self._changed(dict(self._states))

    async def _ask(self, name: str) -> str:
        """Request the state of a node; empty if it does not answer."""
        try:
            response = await self._calls.ask(GetState, f"{name}/get_state", GetState.Request())
        except NoAnswer:
            return ""
        self._set(name, response.current_state.label)
        return response.current_state.label

    async def change(self, name: str, transition: str) -> Answer:
        """Request a transition by its label; the answer contains the resulting state."""
        try:
            request = GetAvailableTransitions.Request()
            offered = await self._calls.ask(GetAvailableTransitions, f"{name}/get_available_transitions", request)
            known = {each.transition.label: each.transition for each in offered.available_transitions}
            if transition not in known:
                state = await self._ask(name)
                possible = f"possible: {', '.join(known)}" if known else "nothing is possible any more"
                return Answer(False, f"{name} is {state}, from where {transition} is not possible; {possible}")
            wanted = ChangeState.Request(transition=known[transition])
            response = await self._calls.ask(ChangeState, f"{name}/change_state", wanted, TRANSITION_TIMEOUT_S)
        except NoAnswer as error:
            return Answer(False, str(error))
        state = await self._ask(name)
        if response.success:
            return Answer(True, f"{name} is {state} now")
        return Answer(False, f"{name} refused to {transition}, and is {state}")


def _lifecycle_nodes(graph: GraphInfo) -> Iterator[str]:
    for node in graph.nodes:
        if not node.hidden and any(
            each.name == f"{node.name}/get_state" and GET_STATE in each.types for each in node.services
        ):
            yield node.name
