"""The base of everything an executor serves: timers, subscriptions, guard conditions, clients, services, waitables."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.impl.callables import is_coroutine_function
from rclpy.impl.callback_order import WAITABLE, OrderKey, next_creation, order_key

if TYPE_CHECKING:
    from collections import deque
    from collections.abc import Callable, Coroutine

    from bot_console.runtime.process.clock_source import Wakeup

DESTROYED = "cannot use Destroyable because destruction was requested"


class EntityGroup(Protocol):
    """What entities need of a callback group."""

    @property
    def own_rules(self) -> bool:
        """Whether the group has a class of the program's own."""
        ...

    @property
    def blocked(self) -> Sequence[Entity] | None:
        """Ready entities that have to wait for the group; None if there are none."""
        ...

    def add_entity(self, entity: Entity) -> None:
        """Add an entity to the group."""

    def block(self, entity: Entity) -> None:
        """Register an entity that may not run now."""

    def unblock(self) -> None:
        """Notify waiting entities that they may try again."""

    def can_execute(self, entity: Entity) -> bool:
        """Whether the entity's callback may run now."""
        ...

    def beginning_execution(self, entity: Entity) -> bool:
        """Mark the entity's callback as running, if that is allowed; returns whether it was."""
        ...

    def ending_execution(self, entity: Entity) -> None:
        """Mark the entity's callback as ended."""


class EntityExecutor(Protocol):
    """What entities need of an executor."""

    receives_in_one_thread: bool
    _ready: deque[Entity]
    _waiting: int
    _wakeup: Wakeup

    def arm(self, timer: Entity, deadline: int) -> None:
        """Set the steady time (ns) at which an entity is due."""

    def ask_again(self, entity: Entity) -> None:
        """Retry, at the next wake, an entity that may not begin now."""

    def create_task(self, callback: Callable[..., object] | Coroutine[object, None, object], *args: object) -> object:
        """Schedule a function in the executor."""
        ...


class Entity:
    """Something that becomes ready and whose callback an executor then runs."""

    KIND = WAITABLE
    marked: EntityExecutor | None = None
    """The executor whose queue of ready entities contains it."""
    destroyed = False
    sink: EntityExecutor | None = None
    """The executor that serves the entity's node."""
    heap: object = None
    heap_deadline = 0
    due_at = 0
    arms_itself = False
    """Whether it reports its next due time to the executor before its callback, and need not be asked afterwards."""
    refusals = 0
    """How often its callback group has made it wait, since it last ran in an executor with several threads."""

    def __init__(self, callback_group: EntityGroup) -> None:
        self.callback_group = callback_group
        self.order = next_creation()
        self.key: OrderKey = order_key(self.KIND, 0, self.order)

    def notify(self) -> None:
        """Mark the entity as ready; thread-safe."""
        sink = self.sink
        # Marked once per wake: a thousand messages before that occupy a single place in the queue.
        if sink is not None and self.marked is not sink:
            self.marked = sink
            sink._ready.append(self)
            if sink._waiting:
                sink._wakeup.set()

    def refused(self) -> None:
        """Mark the entity as ready once more, after it had to wait for its callback group."""
        self.refusals += 1
        self.notify()

    def pending(self) -> bool:
        """Whether there is something to do."""
        raise NotImplementedError

    def awaits(self, future: object) -> bool:
        """Whether a future is completed by something that arrives for this entity."""
        return False

    def arm(self) -> None:
        """Report to the executor when the entity will be ready, if that depends on time."""

    def run(self) -> object:
        """Process one event; the executor drives a returned coroutine."""
        raise NotImplementedError

    def interfaces(self) -> Sequence[type]:
        """Return the interface classes that the entity uses beyond its node's topics and services."""
        return ()

    def attach(self, sink: EntityExecutor, node_order: int) -> None:
        """Attach the entity to an executor."""
        self._belong(sink, node_order)
        if self.pending():
            self.notify()

    def _belong(self, sink: EntityExecutor, node_order: int) -> None:
        self.key = order_key(self.KIND, node_order, self.order)
        self.sink = sink

    def destroy(self) -> None:
        """Leave the graph and the executor."""
        raise NotImplementedError

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
