"""Running a lifecycle node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend import expose_action
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution
from launch_ros.actions.lifecycle_transition import LifecycleTransition
from launch_ros.actions.node import Node
from launch_ros.utilities.lifecycle_event_manager import LifecycleEventManager
from lifecycle_msgs.msg import Transition

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("lifecycle_node")
class LifecycleNode(Node):
    """Runs a node whose state the launch observes (`StateTransition`) and controls (`ChangeState`)."""

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        autostart: bool | SomeSubstitutionsType = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__autostart = normalize_typed_substitution(autostart, bool)
        self.__manager: LifecycleEventManager | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser, ignore: Any = None) -> tuple[Any, dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser, ignore)
        autostart = entity.get_attr("autostart", data_type=bool, optional=True)
        if autostart is not None:
            kwargs["autostart"] = parser.parse_if_substitutions(autostart)
        return cls, kwargs

    @property
    def node_autostart(self) -> Any:
        """Whether the node is activated as soon as it is running."""
        return self.__autostart

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Subscribe to the node's transitions, then start it."""
        self._perform_substitutions(context)
        self.__manager = LifecycleEventManager(self)
        self.__manager.setup_lifecycle_manager(context)
        entities = super().execute(context)
        if not perform_typed_substitution(context, self.__autostart, bool):
            return entities
        return [*(entities or ()), make_active(self.node_name)]


def make_active(node_name: str) -> LifecycleTransition:
    """Return an action that configures a lifecycle node, then activates it."""
    transitions = [Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]
    return LifecycleTransition(lifecycle_node_names=[node_name], transition_ids=transitions)
