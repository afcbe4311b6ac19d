"""Actions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.events import ExecutionComplete
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.origin import origin_of_caller

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class Action(LaunchDescriptionEntity):
    """An entity that does something, unless its condition is false."""

    def __init__(self, *, condition: Condition | None = None) -> None:
        self.__condition = condition
        self.origin = origin_of_caller()
        """Where the action was created, as `file:line`."""

    @property
    def condition(self) -> Condition | None:
        """The condition, or None."""
        return self.__condition

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, object]]:
        """Return the class and keyword arguments of an action in XML or YAML."""
        condition = parser.parse_condition(entity) if hasattr(parser, "parse_condition") else None
        return cls, {"condition": condition} if condition is not None else {}

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Execute the action if its condition holds, and emit `ExecutionComplete` when the action is done."""
        if self.__condition is not None and not self.__condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            event = ExecutionComplete(action=self)
            if context.would_handle_event(event):
                future = self.get_asyncio_future()
                if future is not None:
                    future.add_done_callback(lambda _: context.emit_event_sync(event))
                else:
                    context.emit_event_sync(event)

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities below the action."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities below the action; none if it has a condition."""
        return self.get_sub_entities() if self.__condition is None else []

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[LaunchDescriptionEntity]]]:
        """Return the entities below an action that has a condition, with a text."""
        if self.__condition is None:
            return []
        return [(f"Conditionally included by {self.describe()}", self.get_sub_entities())]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Perform the action; returns the entities to visit next."""
        return None
