"""A lifecycle node shall change its state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch.event import Event


class ChangeState(Event):
    """The lifecycle nodes that a predicate chooses shall make a transition."""

    name = "launch_ros.events.lifecycle.ChangeState"

    def __init__(self, *, lifecycle_node_matcher: Callable[[Any], bool], transition_id: int) -> None:
        super().__init__()
        self.__lifecycle_node_matcher = lifecycle_node_matcher
        self.__transition_id = transition_id

    @property
    def lifecycle_node_matcher(self) -> Callable[[Any], bool]:
        """The predicate over actions."""
        return self.__lifecycle_node_matcher

    @property
    def transition_id(self) -> int:
        """The transition, as in `lifecycle_msgs/msg/Transition`."""
        return self.__transition_id
