"""The state machine of a managed node, with its services and topic."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.endpoints import Endpoint, new_gid, no_event
from bot_console.runtime.rosidl.conversion import type_name
from lifecycle_msgs.msg import State, TransitionEvent
from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle.transition_map import STATES, TRANSITIONS, TransitionRow
from rclpy.logging import get_logger
from rclpy.node_parts.topic_names import checked_name
from rclpy.qos import QoSProfile

if TYPE_CHECKING:
    from rclpy.node import Node

TransitionTuple = tuple[int, str, int, str, int, str]
"""A transition: its id and label, and those of its start and goal states."""


class LifecycleStateMachine:
    """Holds the current state, and publishes each change on the topic `~/transition_event`.

    As upstream, it also publishes if the communication interface is off, which then means only the services.
    """

    def __init__(self, node: Node, enable_com_interface: bool) -> None:
        if not hasattr(enable_com_interface, "__bool__"):  # upstream's C++ also converts numbers and None
            raise TypeError(f"enable_communication_interface must be a bool, not {type(enable_com_interface)}")
        self._state: int = State.PRIMARY_STATE_UNCONFIGURED
        topic = checked_name(node, "~/transition_event")
        kind = type_name(TransitionEvent)
        endpoint = Endpoint(node._ros_id, topic, kind, QoSProfile(depth=10), new_gid(), TransitionEvent)
        bus: Bus = node._ros_bus
        self._publish: Callable[[Any], None] = bus.create_publisher(endpoint, no_event).publish

    @property
    def initialized(self) -> bool:
        """Whether the machine can be used; always True."""
        return True

    @property
    def current_state(self) -> tuple[int, str]:
        """Id and label of the current state."""
        return self._state, STATES[self._state]

    @property
    def available_states(self) -> list[tuple[int, str]]:
        """Id and label of all states."""
        return list(STATES.items())

    @property
    def available_transitions(self) -> list[TransitionTuple]:
        """The transitions from the current state."""
        return [_transition_tuple(each) for each in self._valid()]

    @property
    def transition_graph(self) -> list[TransitionTuple]:
        """All transitions."""
        return [_transition_tuple(each) for each in TRANSITIONS]

    def get_transition_by_label(self, label: str) -> int:
        """Return the id of a transition from the current state; raises `RCLError`."""
        found = self._find(lambda each: each.label == label, label)
        if found is None:
            raise RCLError("Failed to get transition from label")
        return found.id

    def trigger_transition_by_id(self, transition_id: int, publish_update: bool) -> None:
        """Make a transition; raises `RCLError` if it does not start from the current state."""
        self._trigger(self._find(lambda each: each.id == transition_id, transition_id), publish_update)

    def trigger_transition_by_label(self, label: str, publish_update: bool) -> None:
        """Make a transition; raises `RCLError` if it does not start from the current state."""
        self._trigger(self._find(lambda each: each.label == label, label), publish_update)

    def _valid(self) -> list[TransitionRow]:
        return [each for each in TRANSITIONS if each.start == self._state]

    def _find(self, fits: Callable[[TransitionRow], bool], what: int | str) -> TransitionRow | None:
        for each in self._valid():
            if fits(each):
                return each
        state = STATES[self._state]
        get_logger("rcl_lifecycle").warning(f"No transition matching {what} found for current state {state}")
        return None

    def _trigger(self, transition: TransitionRow | None, publish_update: bool) -> None:
        if transition is None:
            raise RCLError("Failed to trigger lifecycle state machine transition: Transition is not registered.")
        self._state = transition.goal
        if publish_update:
            event = TransitionEvent()
            event.start_state = State(id=transition.start, label=STATES[transition.start])
            event.goal_state = State(id=transition.goal, label=STATES[transition.goal])
            self._publish(event)


def _transition_tuple(row: TransitionRow) -> TransitionTuple:
    return row.id, row.label, row.start, STATES[row.start], row.goal, STATES[row.goal]
