"""The tasks of an executor: coroutines under way, and what `create_task` has scheduled."""

# pyright: reportPrivateUsage=false
# The modules of rclpy are one library: what its users are not to touch has an underscore, as upstream.

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

from rclpy.task import Task


class TaskQueue:
    """The methods of `Executor` that keep tasks and continue them."""

    _tasks: dict[Task[Any], Any]
    _ready_tasks: list[Task[Any]]
    _lock: Any
    _waiting: int
    _wakeup: Any
    _is_shutdown: bool
    _ended: Callable[[Any], None]

    def create_task(
        self, callback: Callable[..., Any] | Coroutine[Any, Any, Any], *args: Any, **kwargs: Any
    ) -> Task[Any]:
        """Schedule a function or coroutine in this executor; thread-safe."""
        if self._is_shutdown:
            raise AttributeError("this executor was shut down: it takes no more tasks")
        task: Task[Any] = Task(callback, args, kwargs, executor=self)
        self._enter(task, None)
        return task

    def _enter(self, task: Task[Any], entity: Any) -> None:
        with self._lock:
            self._tasks[task] = entity
            self._ready_tasks.append(task)
        if self._waiting:
            self._wakeup.set()

    def _resume(self, task: Task[Any]) -> None:
        with self._lock:
            if task in self._tasks and task not in self._ready_tasks:
                self._ready_tasks.append(task)
        if self._waiting:
            self._wakeup.set()

    def _run_task(self, task: Task[Any]) -> None:
        try:
            task()
        except BaseException:  # a Ctrl-C, SystemExit, asyncio's CancelledError: the coroutine has ended with it
            self._forget(task)
            raise
        if not task.done():
            if task.cancelled():
                self._forget(task)
            elif task.waits_for is not None:
                task.waits_for._when_settled(lambda: self._resume(task))
            else:
                self._resume(task)
            return
        self._forget(task)
        error = task.exception()
        if error is not None:
            raise error

    def _collect_tasks(self) -> list[Task[Any]]:
        """The tasks that can continue, newest first."""
        with self._lock:
            tasks, self._ready_tasks = self._ready_tasks, []
            if len(tasks) > 1:
                order = {task: place for place, task in enumerate(self._tasks)}
                tasks.sort(key=lambda task: order.get(task, 0), reverse=True)
        return tasks

    def _forget(self, task: Task[Any]) -> None:
        with self._lock:
            entity = self._tasks.pop(task, None)
        if entity is not None:
            self._ended(entity)
