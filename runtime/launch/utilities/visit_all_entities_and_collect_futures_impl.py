"""Visiting entities."""

from __future__ import annotations

import asyncio
from typing import Any


def visit_all_entities_and_collect_futures(entity: Any, context: Any) -> list[tuple[Any, asyncio.Future[Any]]]:
    """Visit an entity, then all that come of it, depth first; each that is not done at once comes with its future."""
    below = entity.visit(context)
    found = []
    future = entity.get_asyncio_future()
    if future is not None:
        found.append((entity, future))
    for each in below or ():
        found += visit_all_entities_and_collect_futures(each, context)
    return found
