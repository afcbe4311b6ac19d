"""Normalize entities to a list."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, cast

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.some_entities_type import SomeEntitiesType


def normalize_to_list_of_entities(entities: SomeEntitiesType) -> list[LaunchDescriptionEntity]:
    """Return a flat list from an entity or nested iterables of them; raises `TypeError` for anything else."""
    found: list[LaunchDescriptionEntity] = []
    given = cast("Iterable[Any]", entities if isinstance(entities, Iterable) else (entities,))
    for each in given:
        if isinstance(each, LaunchDescriptionEntity):
            found.append(each)
        elif isinstance(each, Iterable) and not isinstance(each, str):
            found.extend(normalize_to_list_of_entities(cast("Iterable[LaunchDescriptionEntity]", each)))
        else:
            raise TypeError(
                f"Failed to normalize given item of type '{type(each)}', when only 'launch.LaunchDescriptionEntity' "
                "were expected."
            )
    return found
