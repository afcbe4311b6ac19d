"""The base of custom executors, which take the ready callbacks and run them in any thread they like."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rclpy.impl.callables import is_coroutine_function
from rclpy.task import Future, Task

if TYPE_CHECKING:
    from rclpy.impl.entity import Entity
    from rclpy.node_parts.base import NodeBase


class TimeoutObject:
    """A time-out (s) that can be changed while a wait for it is running."""

    def __init__(self, timeout: float) -> None:
        self.timeout = timeout


async def await_or_execute(callback: Callable[..., Any], *args: object) -> Any:
    """Await a coroutine function, or call a plain one; returns its result."""
    if is_coroutine_function(callback):
        return await callback(*args)
    return callback(*args)


class ReadyCallbacks:
    """The methods of `Executor` that hand out work instead of doing it."""

    _nodes: dict[NodeBase, int]
    _take: Callable[[float | None, Callable[[], bool] | None, set[NodeBase] | None], Entity | Task[Any]]
    _run: Callable[[Entity | Task[Any]], None]
    _ended: Callable[[Entity], None]
    _resume: Callable[[Task[Any]], None]
    _tasks: dict[Task[Any], Entity | None]

    if TYPE_CHECKING:

        def create_task(self, callback: Callable[..., object], *args: object) -> object:
            """Schedule a function in this executor."""

    def wait_for_ready_callbacks(
        self,
        timeout_sec: float | TimeoutObject | None = None,
        nodes: Iterable[NodeBase] | None = None,
        condition: Callable[[], bool] | None = None,
    ) -> tuple[Task[Any], Entity | None, NodeBase | None]:
        """Return the next piece of work as (task, entity, node): calling the task, in any thread, runs the callback.

        The work is limited to the given nodes, if any. Raises `TimeoutException`, `ShutdownException`,
        `ExternalShutdownException` and, once `condition()` is true, `ConditionReachedException`.
        """
        timeout = timeout_sec.timeout if isinstance(timeout_sec, TimeoutObject) else timeout_sec
        wanted = None if nodes is None else set(nodes)
        others: list[Entity | Task[Any]] = []
        try:
            while True:
                item = self._take(timeout, condition, wanted)
                entity, node = self._origin(item)
                if wanted is None or node is None or node in wanted:
                    return Task(self._run, (item,), executor=self), entity, node
                others.append(item)
        finally:
            for item in others:
                self._give_back(item)

    def create_future(self) -> Future[Any]:
        """Return a future whose done callbacks run in this executor."""
        return Future(executor=self)

    def can_execute(self, entity: Entity) -> bool:
        """Whether the entity's callback group allows its callback to begin now."""
        return entity.callback_group.can_execute(entity)

    def _origin(self, item: Entity | Task[Any]) -> tuple[Entity | None, NodeBase | None]:
        """Return the entity and node of a callback; the entity is None for a task created by `create_task`."""
        entity = self._tasks.get(item) if isinstance(item, Task) else item
        return entity, next((node for node in self._nodes if entity in node._ros_entities), None)

    def _give_back(self, item: Entity | Task[Any]) -> None:
        if isinstance(item, Task):
            self._resume(item)
        else:
            self._ended(item)
            if item.pending():  # includes a timer here, which has not run and so was not armed
                item.notify()
