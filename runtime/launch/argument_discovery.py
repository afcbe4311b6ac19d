"""Find the arguments declared in a tree of entities, as upstream does: also in includes and conditional branches."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity

Includes = list[Any] | None


class DeclaresArgument:
    """Base class of the action that declares a launch argument; it is here so that this module does not import it."""


class IncludesDescription:
    """Base class of the action that includes a launch description."""


class ResetsConfigurations:
    """Base class of the action that resets all launch configurations."""


def discover(entities: Iterable[LaunchDescriptionEntity], conditional: bool) -> list[tuple[Any, Includes]]:
    """Return the arguments, each with the includes that may give it a value, or None for the description's own.

    An action that resets all configurations ends its own list of entities, but not the enclosing ones. An argument is
    conditional only if it or its own list of entities is conditional; deeper levels of a branch are not.
    """
    walk = _Walk()
    walk.entities(entities, None, conditional)
    return walk.found


class _Walk:
    def __init__(self) -> None:
        self.found: list[tuple[Any, Includes]] = []
        self._names: set[str] = set()

    def entities(self, entities: Iterable[LaunchDescriptionEntity], includes: Includes, conditional: bool) -> None:
        """Walk entities in order; all includes below the first one share one list."""
        for entity in entities:
            kind: type = entity.__class__
            if issubclass(kind, DeclaresArgument):
                self._add_declared(entity, includes, conditional)
            if issubclass(kind, ResetsConfigurations):
                return
            below = includes
            if issubclass(kind, IncludesDescription):
                below = [] if includes is None else includes
                below.append(entity)
            self.entities(entity.describe_sub_entities(), below, False)
            for _, entities_of_branch in entity.describe_conditional_sub_entities():
                self.entities(entities_of_branch, below, True)

    def _add_declared(self, argument: Any, includes: Includes, conditional: bool) -> None:
        if argument.name not in self._names:
            self._names.add(argument.name)
            argument._conditionally_included = conditional or argument.condition is not None
            self.found.append((argument, includes))
