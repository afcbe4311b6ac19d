"""Finds the arguments that a tree of entities declares, includes and conditional branches counted."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


def discover(entities: Iterable[Any], conditional: bool) -> list[tuple[Any, list[Any]]]:
    """Arguments with the includes on the way to each; stops at an action that resets all configurations."""
    found: list[tuple[Any, list[Any]]] = []
    _Walk(found).entities(entities, [], conditional)
    return found


class _Walk:
    def __init__(self, found: list[tuple[Any, list[Any]]]) -> None:
        self._found = found
        self._names: set[str] = set()

    def entities(self, entities: Iterable[Any], includes: list[Any], conditional: bool) -> bool:
        """Walk entities in order; whether the walk may go on."""
        from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, ResetLaunchConfigurations

        for entity in entities:
            if isinstance(entity, DeclareLaunchArgument):
                self._declared(entity, includes, conditional)
            if isinstance(entity, ResetLaunchConfigurations):
                return False
            below = [*includes, entity] if isinstance(entity, IncludeLaunchDescription) else includes
            branch = conditional or getattr(entity, "condition", None) is not None
            if not self.entities(entity.describe_sub_entities(), below, branch):
                return False
            for _, entities_of_branch in entity.describe_conditional_sub_entities():
                self.entities(entities_of_branch, below, True)
        return True

    def _declared(self, argument: Any, includes: list[Any], conditional: bool) -> None:
        argument._conditionally_included = conditional or argument.condition is not None
        if argument.name not in self._names:
            self._names.add(argument.name)
            self._found.append((argument, list(includes)))
