"""Finds the arguments declared in a tree of entities, includes and conditional branches included, as upstream does."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

Includes = list[Any] | None


class DeclaresArgument:
    """Base of the action that declares a launch argument. The actions know this module, not it them."""


class IncludesDescription:
    """Base of the action that includes a launch description."""


class ResetsConfigurations:
    """Base of the action that resets all launch configurations."""


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
        for entity in entities:
            kind: type = entity.__class__
            if issubclass(kind, DeclaresArgument):
                self._declared(entity, includes, conditional)
            if issubclass(kind, ResetsConfigurations):
                return
            below = includes
            if issubclass(kind, IncludesDescription):
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
