"""Simulated time for the launch itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution
from launch_ros.ros_adapters import get_ros_node
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


@expose_action("set_use_sim_time")
class SetUseSimTime(Action):
    """Makes the launch's own node follow `/clock`, as `ROSTimer` needs; nodes that it starts are not affected."""

    def __init__(self, value: Any, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__value = normalize_typed_substitution(value, bool)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetUseSimTime], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    @property
    def value(self) -> Any:
        """Whether simulated time is used."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """Set the parameter."""
        wanted = perform_typed_substitution(context, self.__value, bool)
        get_ros_node(context).set_parameters([Parameter("use_sim_time", value=wanted)])
