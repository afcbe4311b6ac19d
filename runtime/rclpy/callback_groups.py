"""Callback groups: which callbacks may run at the same time."""

from __future__ import annotations

import weakref
from _thread import allocate_lock
from typing import Any


class CallbackGroup:
    """Holds entities by weak reference, and decides which of them may run. The base of both kinds of group."""

    blocked: list[Any] | None = None
    """Entities that are ready and have to wait for the group, or nothing."""
    own_rules = False
    """Whether it is a program's own class, which does not report when a waiting entity may begin."""
    _full = 64
    """The number of entities, deleted ones included, from which deleted ones are removed before another one is
    added.
    """

    def __init_subclass__(cls, **kwargs: object) -> None:
        super().__init_subclass__(**kwargs)
        cls.own_rules = cls.__module__ != __name__

    def __init__(self) -> None:
        self.entities: set[Any] = set()

    def block(self, entity: Any) -> None:
        """Register an entity that may not run now, to be notified when it may."""
        if self.own_rules:
            entity.sink.ask_again(entity)
            return
        if self.blocked is None:
            self.blocked = []
        self.blocked.append(entity)
        if self.can_execute(entity):  # the callback it waited for has ended meanwhile in another thread
            self.unblock()

    def unblock(self) -> None:
        """Notify waiting entities that they may try again."""
        blocked, self.blocked = self.blocked, None
        for entity in blocked or ():
            entity.notify()

    def add_entity(self, entity: object) -> None:
        """Add an entity to the group."""
        if len(self.entities) >= self._full:
            # Dead references go here, not when they die: else the set could change while a program iterates over it.
            known = tuple(self.entities)  # an atomic copy: other threads may add meanwhile
            self.entities.difference_update([each for each in known if each() is None])
            self._full = 2 * max(len(self.entities), CallbackGroup._full)
        self.entities.add(weakref.ref(entity))

    def has_entity(self, entity: object) -> bool:
        """Whether an entity belongs to the group."""
        return weakref.ref(entity) in self.entities

    def can_execute(self, entity: object) -> bool:
        """Whether the entity's callback may run now."""
        raise NotImplementedError

    def beginning_execution(self, entity: object) -> bool:
        """Mark the entity's callback as running, if that is allowed; returns whether it was."""
        raise NotImplementedError

    def ending_execution(self, entity: object) -> None:
        """Mark the entity's callback as ended."""
        raise NotImplementedError


class ReentrantCallbackGroup(CallbackGroup):
    """Every callback may run at any time."""

    def can_execute(self, entity: object) -> bool:
        """Whether the entity's callback may run now: always."""
        return True

    def beginning_execution(self, entity: object) -> bool:
        """Mark the entity's callback as running, which is always allowed."""
        return True

    def ending_execution(self, entity: object) -> None:
        """Mark the entity's callback as ended."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """At most one callback of the group runs at any time."""

    def __init__(self) -> None:
        super().__init__()
        self._active_entity: Any = None
        self._busy = allocate_lock()

    def can_execute(self, entity: object) -> bool:
        """Whether no callback of the group is running."""
        return not self._busy.locked()

    def beginning_execution(self, entity: object) -> bool:
        """Mark the entity's callback as running, unless another callback of the group is."""
        if self._busy.acquire(False):
            self._active_entity = entity
            return True
        return False

    def ending_execution(self, entity: object) -> None:
        """Mark the entity's callback as ended."""
        if self._active_entity is entity:
            self._active_entity = None
            self._busy.release()
