"""A lifecycle node that a container loads: newer than Jazzy's first release, but used in public launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.utilities.type_utils import normalize_typed_substitution
from launch_ros.descriptions.composable_node import ComposableNode
from launch_ros.utilities.lifecycle_event_manager import LifecycleEventManager

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class ComposableLifecycleNode(ComposableNode):
    """A node class that a running container loads, and whose state the launch observes and controls."""

    def __init__(self, *, autostart: bool | SomeSubstitutionsType = False, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__autostart = normalize_typed_substitution(autostart, bool)
        self.__full_name: str | None = None

    @property
    def node_autostart(self) -> Any:
        """Whether the node is activated as soon as it is loaded."""
        return self.__autostart

    @property
    def node_name(self) -> Any:
        """The node's name; its full name once the launch knows it."""
        return super().node_name if self.__full_name is None else self.__full_name

    def init_lifecycle_event_manager(self, context: LaunchContext, full_name: str) -> None:
        """Observe and control the node with this full name."""
        self.__full_name = full_name
        LifecycleEventManager(self).setup_lifecycle_manager(context)
