"""What a launch description is made of."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchDescriptionEntity:
    """Something that can be visited with a context."""

    def describe(self) -> str:
        """A short text for people."""
        return self.__repr__()

    def describe_sub_entities(self) -> list[Any]:
        """Entities below this one that are always visited with it."""
        return []

    def describe_conditional_sub_entities(self) -> list[Any]:
        """Texts with the entities that are visited when what the text says comes about."""
        return []

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Do what the entity is for; gives entities to visit next."""
        return None

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """A future that is done when the entity is, or None."""
        return None
