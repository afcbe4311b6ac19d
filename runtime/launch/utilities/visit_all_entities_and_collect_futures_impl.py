"""Visiting entities recursively."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from launch.launch_place import report_visited

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity, context: LaunchContext
) -> list[tuple[LaunchDescriptionEntity, asyncio.Future[None]]]:
    """Visit an entity and those it returns, depth first; return those that are not done at once, with futures."""
    try:
        below = entity.visit(context)
    except Exception as error:
        report_visited(error, entity)
        raise
    found: list[tuple[LaunchDescriptionEntity, asyncio.Future[None]]] = []
    future = entity.get_asyncio_future()
    if future is not None:
        found.append((entity, future))
    for each in below or ():
        found += visit_all_entities_and_collect_futures(each, context)
    return found
