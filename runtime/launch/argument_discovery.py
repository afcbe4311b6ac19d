"""Finds the arguments that a tree of entities declares, includes and conditional branches counted, as upstream does."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

Includes = list[Any] | None


def discover(entities: Iterable[Any], conditional: bool) -> list[tuple[Any, Includes]]:
    """Arguments, each with the includes that may give it a value; None for those of the description itself.

    An action that resets all configurations ends the list that it is in, not the lists around that. An argument is
    conditional only where itself, or the list that it stands in, is: what lies deeper in a branch is not.
    """
    walk = _Walk()
    walk.entities(entities, None, conditional)
    return walk.found


class _Walk:
    def __init__(self) -> None:
        self.found: list[tuple[Any, Includes]] = []
        self._names: set[str] = set()

    def entities(self, entities: Iterable[Any], includes: Includes, conditional: bool) -> None:
        """Walk entities in order; below the first include, all includes share one list."""
        from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, ResetLaunchConfigurations

        for entity in entities:
            if isinstance(entity, DeclareLaunchArgument):
                self._declared(entity, includes, conditional)
            if isinstance(entity, ResetLaunchConfigurations):
                return
            below = includes
            if isinstance(entity, IncludeLaunchDescription):
                below = [] if includes is None else includes
                below.append(entity)
            self.entities(entity.describe_sub_entities(), below, False)
            for _, entities_of_branch in entity.describe_conditional_sub_entities():
                self.entities(entities_of_branch, below, True)

    def _declared(self, argument: Any, includes: Includes, conditional: bool) -> None:
        if argument.name not in self._names:
            self._names.add(argument.name)
            argument._conditionally_included = conditional or argument.condition is not None
            self.found.append((argument, includes))
