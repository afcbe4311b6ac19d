"""Callback groups: which callbacks may run at the same time."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import weakref
from _thread import allocate_lock
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.impl.entity import Entity


class CallbackGroup:
    """Holds entities by weak reference, and decides which of them may run. The base of both kinds of group."""

    blocked: list[Entity] | None = None
    """Ready entities that have to wait for the group; None if there are none."""
    own_rules = False
    """Whether the group has a class of the program's own, which does not report when a waiting entity may begin."""
    _full = 64
    """How many entities, including deleted ones, the group may hold before an addition removes deleted ones."""

    def __init_subclass__(cls, **kwargs: object) -> None:
        super().__init_subclass__(**kwargs)
        cls.own_rules = cls.__module__ != __name__

    def __init__(self) -> None:
        self.entities: set[weakref.ref[object]] = set()

    def block(self, entity: Entity) -> None:
        """Register an entity that may not run now, to notify it when it may."""
        if self.own_rules:
            if entity.sink is not None:
                entity.sink.ask_again(entity)
            return
        if self.blocked is None:
            self.blocked = []
        self.blocked.append(entity)
        if self.can_execute(entity):  # the callback it waited for has meanwhile ended in another thread
            self.unblock()

    def unblock(self) -> None:
        """Notify waiting entities that they may try again."""
        blocked, self.blocked = self.blocked, None
        for entity in dict.fromkeys(blocked or ()):
            entity.refused()

    def add_entity(self, entity: object) -> None:
        """Add an entity to the group."""
        if len(self.entities) >= self._full:
            # Dead references are removed here, not when they die: otherwise the set could change while a program
            # iterates over it.
            known = tuple(self.entities)  # an atomic copy, as other threads may add entities meanwhile
            self.entities.difference_update([each for each in known if each() is None])
            self._full = 2 * max(len(self.entities), CallbackGroup._full)
        self.entities.add(weakref.ref(entity))

    def has_entity(self, entity: object) -> bool:
        """Whether an entity belongs to the group."""
        return weakref.ref(entity) in self.entities

    def can_execute(self, entity: Entity) -> bool:
        """Whether the entity's callback may run now."""
        raise NotImplementedError

    def beginning_execution(self, entity: Entity) -> bool:
        """Mark the entity's callback as running, if that is allowed; returns whether it was."""
        raise NotImplementedError

    def ending_execution(self, entity: Entity) -> None:
        """Mark the entity's callback as ended."""
        raise NotImplementedError


class ReentrantCallbackGroup(CallbackGroup):
    """Every callback may run at any time."""

    def can_execute(self, entity: Entity) -> bool:
        """Whether the entity's callback may run now: always."""
        return True

    def beginning_execution(self, entity: Entity) -> bool:
        """Mark the entity's callback as running, which is always allowed."""
        return True

    def ending_execution(self, entity: Entity) -> None:
        """Mark the entity's callback as ended."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """At most one callback of the group runs at any time."""

    def __init__(self) -> None:
        super().__init__()
        self._active_entity: Entity | None = None
        self._busy = allocate_lock()

    def can_execute(self, entity: Entity) -> bool:
        """Whether no callback of the group is running."""
        return not self._busy.locked()

    def beginning_execution(self, entity: Entity) -> bool:
        """Mark the entity's callback as running, unless another callback of the group is."""
        if self._busy.acquire(False):
            self._active_entity = entity
            return True
        return False

    def ending_execution(self, entity: Entity) -> None:
        """Mark the entity's callback as ended."""
        if self._active_entity is entity:
            self._active_entity = None
            self._busy.release()
