"""A lifecycle node has changed its state."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.action import Action
    from lifecycle_msgs.msg import TransitionEvent


class StateTransition(Event):
    """A lifecycle node has made a transition."""

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: Action, msg: TransitionEvent) -> None:
        super().__init__()
        self.__action = action
        self.__msg = msg

    @property
    def action(self) -> Action:
        """The action that runs the node."""
        return self.__action

    @property
    def msg(self) -> TransitionEvent:
        """The message that reports the transition."""
        return self.__msg

    @property
    def timestamp(self) -> int:
        """The time of the transition (ns)."""
        return self.__msg.timestamp

    @property
    def transition(self) -> str:
        """The transition's label."""
        return self.__msg.transition.label

    @property
    def start_state(self) -> str:
        """The label of the previous state."""
        return self.__msg.start_state.label

    @property
    def goal_state(self) -> str:
        """The label of the new state."""
        return self.__msg.goal_state.label
