"""Event handlers in the order of their calls; fast even if each of hundreds waits for an action of its own."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

Key = tuple[Any, int]


class HandlerRegistry:
    """Handlers, newest first, indexed by the event class and the action that they declare."""

    def __init__(self) -> None:
        self._ranks: dict[int, tuple[int, Any]] = {}
        self._buckets: dict[Key, dict[int, Any]] = {}
        self._before = itertools.count(0, -1)
        self._after = itertools.count(1)

    def __len__(self) -> int:
        return len(self._ranks)

    def __iter__(self) -> Iterator[Any]:
        return iter([handler for _, handler in sorted(self._ranks.values(), key=_rank)])

    def __contains__(self, handler: object) -> bool:
        return id(handler) in self._ranks

    def add(self, handler: object, *, append: bool = False) -> None:
        """Add a handler before all others, or after them."""
        rank = next(self._after if append else self._before)
        self._ranks[id(handler)] = (rank, handler)
        self._buckets.setdefault(_key(handler), {})[id(handler)] = handler

    def remove(self, handler: object) -> None:
        """Remove a handler; raises `ValueError` if it is not registered."""
        if id(handler) not in self._ranks:
            raise ValueError(f"{handler!r} is not registered")
        del self._ranks[id(handler)]
        bucket = self._buckets[_key(handler)]
        del bucket[id(handler)]
        if not bucket:
            del self._buckets[_key(handler)]

    def matching(self, event: object) -> list[Any]:
        """Return the matching handlers, in order."""
        actions = {0, id(getattr(event, "action", None))}
        kinds = (None, *(event.__mro__ if isinstance(event, type) else type(event).__mro__))
        buckets = [self._buckets.get((kind, action)) for kind in kinds for action in actions]
        found = [each for bucket in buckets if bucket for each in bucket.values() if each.matches(event)]
        if len(found) > 1:
            found.sort(key=lambda handler: self._ranks[id(handler)][0])
        return found


def _key(handler: object) -> Key:
    target = getattr(handler, "target_of_events", None)
    return getattr(handler, "kind_of_events", None), 0 if target is None else id(target)


def _rank(pair: tuple[int, Any]) -> int:
    return pair[0]
