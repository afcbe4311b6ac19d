"""The order in which an executor runs callbacks that are ready at the same time, which is upstream's.

Tasks that can continue come first, the newest or the oldest one depending on the distribution; then waitables of any
node. Then come, node by node in the order in which the nodes were added, timers, subscriptions, guard conditions,
clients and services; among these, the one that was created first.

With several threads, a timer that is always due is so again while its callback runs, and would always come first: what
has waited longest for its callback group precedes all else.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from operator import attrgetter
from typing import Protocol, TypeVar

from bot_console.runtime.distribution import distribution

WAITABLE, TIMER, SUBSCRIPTION, GUARD, CLIENT, SERVICE = range(6)
"""Kinds of entities, in the order in which a wake serves them."""

OrderKey = tuple[int, int, int]
"""The position of the node in its executor, the kind, and the position of the entity in the order of creation."""


class Ordered(Protocol):
    """An entity that has a position in the order."""

    @property
    def key(self) -> OrderKey:
        """The entity's `order_key`."""
        ...

    @property
    def refusals(self) -> int:
        """For how many callbacks of its group it has had to wait."""
        ...


EntityT = TypeVar("EntityT", bound=Ordered)
TaskT = TypeVar("TaskT")
_creation = itertools.count()
_key = attrgetter("key")


def next_creation() -> int:
    """Return the position of a new entity in the order of creation in this process."""
    return next(_creation)


def order_key(kind: int, node_order: int, creation: int) -> OrderKey:
    """Return the key by which entities are sorted."""
    return -1 if kind == WAITABLE else node_order, kind, creation


def sort_entities(entities: list[EntityT]) -> None:
    """Sort the entities that are ready in one wake."""
    entities.sort(key=_key)


def sort_longest_refused_first(entities: list[EntityT]) -> None:
    """Sort the entities that are ready in one wake, those first whose group has refused them most often."""
    entities.sort(key=lambda each: (-each.refusals, each.key))


def sort_tasks(tasks: list[TaskT], created: Iterable[TaskT]) -> None:
    """Sort the tasks that can continue, given all tasks in the order of their creation."""
    places = {task: place for place, task in enumerate(created)}
    tasks.sort(key=lambda task: places.get(task, 0), reverse=distribution().newest_task_first)
