"""Logging a message."""

from __future__ import annotations

from typing import TYPE_CHECKING

import launch.logging
from launch.action import Action
from launch.frontend.expose import expose_action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class Message(Action):
    """Base class of actions that log a message."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__msg = normalize_to_list_of_substitutions(msg)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Message], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["msg"] = parser.parse_substitution(entity.get_attr("message"))
        return cls, kwargs

    @property
    def msg(self) -> list[Substitution]:
        """The message."""
        return self.__msg


@expose_action("log")
@expose_action("log_info")
class LogInfo(Message):
    """Logs a message."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(msg=msg, **kwargs)
        self.__logger = launch.logging.get_logger("launch.user")

    def execute(self, context: LaunchContext) -> None:
        """Log the message."""
        self.__logger.info("%s", perform_substitutions(context, self.msg))
