"""The type of arguments that accept entities."""

from __future__ import annotations

from collections.abc import Iterable

from launch.launch_description_entity import LaunchDescriptionEntity

SomeEntitiesType = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]

SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, Iterable)


def check_entities(entities: SomeEntitiesType | None) -> list[LaunchDescriptionEntity]:
    """Return a list of entities from one entity, several or None."""
    if entities is None:
        return []
    return [entities] if isinstance(entities, LaunchDescriptionEntity) else list(entities)
