"""A request for a lifecycle node to change its state."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar

from launch.event import Event
from lifecycle_msgs.msg import State, Transition

if TYPE_CHECKING:
    from launch.action import Action

TRANSITIONS = (
    "TRANSITION_CREATE",
    "TRANSITION_CONFIGURE",
    "TRANSITION_CLEANUP",
    "TRANSITION_ACTIVATE",
    "TRANSITION_DEACTIVATE",
    "TRANSITION_UNCONFIGURED_SHUTDOWN",
    "TRANSITION_INACTIVE_SHUTDOWN",
    "TRANSITION_ACTIVE_SHUTDOWN",
    "TRANSITION_DESTROY",
)
STATES = (
    *(f"PRIMARY_STATE_{name}" for name in ("UNKNOWN", "UNCONFIGURED", "INACTIVE", "ACTIVE", "FINALIZED")),
    *(
        f"TRANSITION_STATE_{name}"
        for name in ("CONFIGURING", "CLEANINGUP", "SHUTTINGDOWN", "ACTIVATING", "DEACTIVATING", "ERRORPROCESSING")
    ),
)


class ChangeState(Event):
    """Requests a transition of the lifecycle nodes that a predicate selects."""

    name = "launch_ros.events.lifecycle.ChangeState"
    valid_transitions: ClassVar[dict[int, str]] = {getattr(Transition, name): name for name in TRANSITIONS}
    """Names of the transitions that can be requested, by number."""
    valid_states: ClassVar[dict[int, str]] = {getattr(State, name): name for name in STATES}
    """Names of states, by number."""

    def __init__(self, *, lifecycle_node_matcher: Callable[[Action], bool], transition_id: int) -> None:
        super().__init__()
        self.__lifecycle_node_matcher = lifecycle_node_matcher
        self.__transition_id = transition_id
        if transition_id not in self.valid_transitions:
            known = ", ".join(f"{name}: {number}" for number, name in self.valid_transitions.items())
            raise ValueError(f"given transition_id of '{transition_id}', expected one of {{{known}}}")

    @property
    def lifecycle_node_matcher(self) -> Callable[[Action], bool]:
        """The predicate over actions."""
        return self.__lifecycle_node_matcher

    @property
    def transition_id(self) -> int:
        """The transition's number in `lifecycle_msgs/msg/Transition`."""
        return self.__transition_id
