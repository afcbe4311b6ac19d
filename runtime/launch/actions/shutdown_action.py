"""Shutting the launch down."""

from __future__ import annotations

from typing import TYPE_CHECKING

import launch.logging
from launch.action import Action
from launch.actions.emit_event import EmitEvent
from launch.events import Shutdown as ShutdownEvent
from launch.events.process import ProcessExited
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("shutdown")
class Shutdown(EmitEvent):
    """Shuts the launch down; if it handles a process exit, it reports that the process was required."""

    def __init__(self, *, reason: SomeSubstitutionsType = "reason not given", **kwargs: Condition | None) -> None:
        super().__init__(event=ShutdownEvent(reason=reason if isinstance(reason, str) else ""), **kwargs)
        self.__reason = normalize_to_list_of_substitutions(reason)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Shutdown], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = Action.parse.__func__(cls, entity, parser)  # type: ignore[attr-defined] -- the base's parser, past the class between
        reason = entity.get_attr("reason", optional=True)
        if reason:
            kwargs["reason"] = parser.parse_substitution(reason)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Shut the launch down."""
        event = context.get_locals_as_dict().get("event")
        if isinstance(event, ProcessExited):
            launch.logging.get_logger("launch").info(
                f"process[{event.process_name}] was required: shutting down launched system"
            )
        context.emit_event_sync(ShutdownEvent(reason=perform_substitutions(context, self.__reason)))
