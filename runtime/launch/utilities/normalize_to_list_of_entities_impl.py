"""Normalize entities to a list."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, cast

from launch.launch_description_entity import LaunchDescriptionEntity


def normalize_to_list_of_entities(entities: Any) -> list[Any]:
    """Return a flat list from an entity or nested iterables of them; raises `TypeError` for anything else."""
    found: list[Any] = []
    given = cast("Iterable[Any]", entities if isinstance(entities, Iterable) else (entities,))
    for each in given:
        if isinstance(each, LaunchDescriptionEntity):
            found.append(each)
        elif isinstance(each, Iterable) and not isinstance(each, str):
            found.extend(normalize_to_list_of_entities(each))
        else:
            raise TypeError(
                f"Failed to normalize given item of type '{type(each)}', when only 'launch.LaunchDescriptionEntity' "
                "were expected."
            )
    return found
