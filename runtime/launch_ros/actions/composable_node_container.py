"""Running a container for composable nodes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.frontend import expose_action
from launch_ros.actions.load_composable_nodes import LoadComposableNodes, condition_holds, parse_composable_nodes
from launch_ros.actions.node import Node

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.descriptions.composable_node import ComposableNode


@expose_action("node_container")
class ComposableNodeContainer(Node):
    """Runs a container and loads nodes into it."""

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        composable_node_descriptions: Iterable[ComposableNode] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__descriptions = composable_node_descriptions

    @classmethod
    def parse(cls, entity: Entity, parser: Parser, ignore: Any = None) -> tuple[Any, dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser, ignore)
        descriptions = parse_composable_nodes(entity, parser, optional=True)
        if descriptions:
            kwargs["composable_node_descriptions"] = descriptions
        kwargs.setdefault("namespace", "")
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the container, then load the nodes whose conditions hold."""
        wanted = [each for each in self.__descriptions or () if condition_holds(each, context)]
        loading = []
        if wanted:
            loading = [LoadComposableNodes(composable_node_descriptions=wanted, target_container=self)]
        entities = super().execute(context)
        return [*(entities or ()), *loading] or None
