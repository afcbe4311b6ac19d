"""The directory of node logs."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from rclpy.logging import get_logging_directory

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("set_ros_log_dir")
class SetROSLogDir(Action):
    """Makes subsequent nodes log to another folder; a relative path is below their current log folder."""

    def __init__(self, new_log_dir: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__log_dir = normalize_to_list_of_substitutions(new_log_dir)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetROSLogDir], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["new_log_dir"] = parser.parse_substitution(entity.get_attr("new_log_dir"))
        return cls, kwargs

    @property
    def log_dir(self) -> list[Substitution]:
        """The folder."""
        return self.__log_dir

    def execute(self, context: LaunchContext) -> None:
        """Set the folder."""
        before = context.environment.get("ROS_LOG_DIR") or os.fspath(get_logging_directory())
        context.environment["ROS_LOG_DIR"] = os.path.join(before, perform_substitutions(context, self.__log_dir))
