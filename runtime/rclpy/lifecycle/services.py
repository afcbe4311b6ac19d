"""The five services by which others query and change a managed node's state."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from bot_console.runtime.distribution import distribution
from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from lifecycle_msgs.msg import State, Transition, TransitionDescription
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle.state_machine import LifecycleStateMachine, TransitionTuple
from rclpy.lifecycle.transition_callback_return import TransitionCallbackReturnType as TransitionCallbackReturn

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node
    from rclpy.service import Service


class LifecycleServices:
    """Serves `~/change_state`, `~/get_state` and the three that list states and transitions."""

    def __init__(
        self,
        node: Node,
        machine: LifecycleStateMachine,
        change_state: Callable[[int], TransitionCallbackReturn],
        group: CallbackGroup | None,
    ) -> None:
        self._machine = machine
        self._change_state = change_state
        self.change_state = _serve(node, ChangeState, "change_state", self._on_change_state, group)
        self.get_state = _serve(node, GetState, "get_state", self._on_get_state, group)
        self.get_available_states = _serve(
            node, GetAvailableStates, "get_available_states", self._on_get_available_states, group
        )
        self.get_available_transitions = _serve(
            node, GetAvailableTransitions, "get_available_transitions", self._on_get_available_transitions, group
        )
        self.get_transition_graph = _serve(
            node, GetAvailableTransitions, "get_transition_graph", self._on_get_transition_graph, group
        )

    def _on_change_state(self, request: ChangeState.Request, response: ChangeState.Response) -> ChangeState.Response:
        """Serve a request: a label precedes an id; an unknown label fails, an invalid id raises out of spin."""
        transition = request.transition.id
        if request.transition.label:
            try:
                transition = self._machine.get_transition_by_label(request.transition.label)
            except RCLError:
                response.success = False
                return response
        valid = [each[0] for each in self._machine.available_transitions]
        if transition not in valid and distribution().invalid_transition_ends_node:
            notify(current(), self._explain_invalid_transition(transition))
        response.success = self._change_state(transition) is TransitionCallbackReturn.SUCCESS
        return response

    def _explain_invalid_transition(self, transition: int) -> str:
        """Return the effect of a request for an invalid transition, and what to request instead."""
        rows = [f"{number} ({label})" for number, label, *_ in self._machine.available_transitions]
        return (
            f"somebody requested transition {transition} by {self.change_state.service_name}, which does not start "
            f"from state '{self._machine.current_state[1]}'. In ROS 2 Jazzy, as here, that ends this node, and whoever "
            f"requested it waits for ever. Possible now: {', '.join(rows) or 'none'}; "
            "~/get_available_transitions lists them"
        )

    def _on_get_state(self, request: GetState.Request, response: GetState.Response) -> GetState.Response:
        number, label = self._machine.current_state
        response.current_state = State(id=number, label=label)
        return response

    def _on_get_available_states(
        self, request: GetAvailableStates.Request, response: GetAvailableStates.Response
    ) -> GetAvailableStates.Response:
        response.available_states = [State(id=number, label=label) for number, label in self._machine.available_states]
        return response

    def _on_get_available_transitions(
        self, request: GetAvailableTransitions.Request, response: GetAvailableTransitions.Response
    ) -> GetAvailableTransitions.Response:
        response.available_transitions = [_message(each) for each in self._machine.available_transitions]
        return response

    def _on_get_transition_graph(
        self, request: GetAvailableTransitions.Request, response: GetAvailableTransitions.Response
    ) -> GetAvailableTransitions.Response:
        response.available_transitions = [_message(each) for each in self._machine.transition_graph]
        return response


def _serve(
    node: Node, kind: ServiceType, name: str, callback: Callable[..., object], group: CallbackGroup | None
) -> Service:
    service = node.create_service(kind, f"~/{name}", callback, callback_group=group)
    # Upstream creates these in rcl, which knows only the full name.
    service.srv_name = service.service_name
    return service


def _message(transition: TransitionTuple) -> TransitionDescription:
    number, label, start, start_label, goal, goal_label = transition
    return TransitionDescription(
        transition=Transition(id=number, label=label),
        start_state=State(id=start, label=start_label),
        goal_state=State(id=goal, label=goal_label),
    )
