"""The position of a process in its launch files: the includes that lead to it, and groups with a namespace."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch import LaunchContext


class LaunchTree:
    """The visited entities of one launch; `title` is the name of its launch file."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._parents: dict[int, tuple[Any, Any]] = {}

    def included(self, include: Any) -> None:
        """Add the contents of an include that was executed: its description is now available without reading a file."""
        description = include.launch_description_source.try_get_launch_description_without_context()
        if description is not None:
            self._add(description.entities, include)

    def _add(self, entities: Iterable[Any], parent: Any) -> None:
        from launch.actions import IncludeLaunchDescription

        for entity in entities:
            if id(entity) in self._parents:
                continue
            self._parents[id(entity)] = (entity, parent)
            if not isinstance(entity, IncludeLaunchDescription):
                self._add(below(entity), entity)

    def _chain(self, entity: Any) -> Iterator[Any]:
        """The entities that contain an entity, innermost first."""
        _, parent = self._parents.get(id(entity), (None, None))
        while parent is not None:
            yield parent
            _, parent = self._parents.get(id(parent), (None, None))

    def file_of(self, entity: Any) -> str:
        """The launch file that contains an entity; empty when unknown."""
        from launch.actions import IncludeLaunchDescription

        includes = (each for each in self._chain(entity) if isinstance(each, IncludeLaunchDescription))
        return next((each.launch_description_source.location for each in includes), "")

    def place(self, action: Any, context: LaunchContext) -> tuple[str, ...]:
        """The position of an action: the names of launch files and the namespaces of groups, outermost first."""
        from launch.actions import GroupAction, IncludeLaunchDescription

        names: list[str] = []
        for each in self._chain(action):
            if isinstance(each, IncludeLaunchDescription):
                names.append(Path(each.launch_description_source.location).name)
            elif isinstance(each, GroupAction):
                names += _namespaces(each, context)
        names = names[:-1] if names else []  # the title stands for the outermost file
        return (self._title, *reversed(names))


def below(entity: Any) -> Iterator[Any]:
    """The entities within an entity, whether or not they are ever visited."""
    yield from getattr(entity, "entities", None) or ()
    yield from entity.get_sub_entities() if hasattr(entity, "get_sub_entities") else ()
    yield from entity.describe_sub_entities()
    for _, entities in entity.describe_conditional_sub_entities():
        yield from entities


def _namespaces(group: Any, context: LaunchContext) -> list[str]:
    from launch.substitutions import SubstitutionFailure
    from launch.utilities import perform_substitutions
    from launch_ros.actions import PushRosNamespace

    for each in group.get_sub_entities():
        if isinstance(each, PushRosNamespace):
            try:
                return [perform_substitutions(context, each.namespace)]
            except SubstitutionFailure:  # needs a launch configuration that only its own scope has
                return []
    return []
