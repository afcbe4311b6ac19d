"""The base of everything an executor serves: timers, subscriptions, guard conditions, clients, services, waitables."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.impl.callables import is_coroutine_function

WAITABLE, TIMER, SUBSCRIPTION, GUARD, CLIENT, SERVICE = range(6)
"""Kinds, in the order in which one wake of an executor serves them."""

DESTROYED = "cannot use Destroyable because destruction was requested"
_creation = itertools.count()


class Entity:
    """Something that becomes ready and whose callback an executor then runs."""

    KIND = WAITABLE
    marked: Any = None
    """The executor whose queue of ready entities contains it."""
    destroyed = False
    sink: Any = None
    """The executor that serves the entity's node."""
    heap: Any = None
    heap_deadline = 0
    due_at = 0
    arms_itself = False
    """Whether it tells the executor its next due time before its callback begins, and need not be asked afterwards."""

    def __init__(self, callback_group: Any) -> None:
        self.callback_group = callback_group
        self.order = next(_creation)
        self.key: tuple[int, int, int] = (0, self.KIND, self.order)

    def notify(self) -> None:
        """Mark the entity as ready; thread-safe."""
        sink = self.sink
        # Marked once per wake: a thousand messages before it take one place in the queue.
        if sink is not None and self.marked is not sink:
            self.marked = sink
            sink._ready.append(self)
            if sink._waiting:
                sink._wakeup.set()

    def pending(self) -> bool:
        """Whether there is something to do."""
        raise NotImplementedError

    def awaits(self, future: Any) -> bool:
        """Whether it is what arrives for the entity that settles a future."""
        return False

    def arm(self) -> None:
        """Tell the executor when the entity will be ready, if that depends on time."""

    def run(self) -> Any:
        """Do one piece of work; the executor drives a returned coroutine."""
        raise NotImplementedError

    def interfaces(self) -> Sequence[Any]:
        """The interface classes that the entity uses beyond its node's topics and services."""
        return ()

    def attach(self, sink: Any, node_order: int) -> None:
        """Attach the entity to an executor."""
        self._belong(sink, node_order)
        if self.pending():
            self.notify()

    def _belong(self, sink: Any, node_order: int) -> None:
        # Upstream's executor checks waitables before everything else, whichever node they belong to.
        self.key = (-1 if self.KIND == WAITABLE else node_order, self.KIND, self.order)
        self.sink = sink

    def detach(self) -> None:
        """Detach the entity from its executor."""
        self.sink = None

    @property
    def callback(self) -> Any:
        """The function to call; the executor drives coroutine functions."""
        return self._callback

    @callback.setter
    def callback(self, value: Any) -> None:
        self._callback = value
        self._is_async = is_coroutine_function(value)

    def use(self) -> None:
        """Raise `InvalidHandle` if the entity was destroyed."""
        if self.destroyed:
            raise InvalidHandle(DESTROYED)
