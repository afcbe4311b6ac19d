"""Executors: they run the callbacks of their nodes' ready entities, in rclpy's order."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import math
import warnings
from _thread import allocate_lock
from collections import deque
from collections.abc import Callable, Coroutine, Generator
from contextlib import contextmanager
from types import TracebackType
from typing import TYPE_CHECKING, Any

from bot_console.runtime.distribution import distribution
from bot_console.runtime.process import current
from rclpy.deadlock import WARNING_DELAY_NS, report_future, runs_in_callback
from rclpy.impl.callback_order import sort_entities, sort_longest_refused_first, sort_tasks
from rclpy.impl.explanations import spun_twice
from rclpy.impl.reexports import reexporting
from rclpy.impl.timer_heap import TimerHeap
from rclpy.impl.unused_overrides import report_unused_overrides
from rclpy.impl.worker_pool import WorkerPool, cpu_count, report_unfetched_at_exit
from rclpy.ready_callbacks import ReadyCallbacks
from rclpy.ready_callbacks import TimeoutObject as TimeoutObject
from rclpy.ready_callbacks import await_or_execute as await_or_execute
from rclpy.task import Future, Task
from rclpy.utilities import get_default_context, timeout_sec_to_nsec

if TYPE_CHECKING:
    from _thread import LockType

    from bot_console.runtime.process.clock_source import Wakeup
    from rclpy.context import Context
    from rclpy.impl.entity import Entity
    from rclpy.node_parts.base import NodeBase


class TaskQueue:
    """The methods of `Executor` that keep tasks and resume them."""

    _tasks: dict[Task[Any], Entity | None]
    _ready_tasks: list[Task[Any]]
    _lock: LockType
    _waiting: int
    _wakeup: Wakeup
    _is_shutdown: bool
    _ended: Callable[[Entity], None]

    def create_task(
        self, callback: Callable[..., object] | Coroutine[object, None, object], *args: object, **kwargs: object
    ) -> Task[Any]:
        """Schedule a function or coroutine in this executor; thread-safe."""
        if self._is_shutdown and not distribution().closed_executor_takes_work:
            raise AttributeError("this executor was shut down: it takes no more tasks")
        task: Task[Any] = Task(callback, args, kwargs, executor=self)
        self._enter(task, None)
        return task

    def _enter(self, task: Task[Any], entity: Entity | None) -> None:
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
        except BaseException:  # for example Ctrl-C, SystemExit, or asyncio's CancelledError: it has ended the coroutine
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
        """Return the tasks that can continue, in the order of the chosen distribution."""
        with self._lock:
            tasks, self._ready_tasks = self._ready_tasks, []
            if len(tasks) > 1:
                sort_tasks(tasks, self._tasks)
        return tasks

    def _forget(self, task: Task[Any]) -> None:
        with self._lock:
            entity = self._tasks.pop(task, None)
        if entity is not None:
            self._ended(entity)


Condition = Callable[[], bool]


class TimeoutException(Exception):
    """Nothing became ready in time."""


class ShutdownException(Exception):
    """The executor was shut down."""


class ExternalShutdownException(Exception):
    """The context was shut down."""

    def __init__(self, *args: object) -> None:
        super().__init__(*args)


class ConditionReachedException(Exception):
    """The awaited condition has become true."""


class Executor(TaskQueue, ReadyCallbacks):
    """Serves nodes; `spin_once` runs one callback.

    An entity marks itself ready once, however many events it has. A wake takes the ready entities and the timers that
    are due, and sorts that batch by (node, kind, creation). This is rclpy's order, at a cost that depends on ready
    entities only.
    """

    receives_in_one_thread = False
    """Whether nothing can be received while a callback runs."""
    _sort = staticmethod(sort_entities)

    def __init__(self, *, context: Context | None = None) -> None:
        self._context = get_default_context() if context is None else context
        self._context.require_running("guard_condition")
        self._clock = current().clock
        self._steady_ns = self._clock.steady_ns
        self._nodes: dict[NodeBase, int] = {}
        self._node_count = 0
        self._ready: deque[Entity] = deque()
        self._batch: deque[Any] = deque()  # entities and tasks, distinguished by their class: `isinstance` is slower
        self._tasks: dict[Task[Any], Entity | None] = {}
        self._ready_tasks: list[Task[Any]] = []
        self._held: list[Entity] = []
        """Ready entities that a callback group of the program's own class did not allow to begin."""
        self._timers = TimerHeap()
        self._lock = allocate_lock()  # held for a few lines that never wait: it blocks nobody, even in a stepped run
        self._wakeup = self._clock.wakeup()
        self._waiting = 0
        self._awaited: tuple[object, ...] | None = None
        """What the thread that is waiting for work has asked for."""
        self._is_shutdown = False
        self.is_global = False
        """Whether this is the executor of `rclpy.spin`, which ends silently with `rclpy.shutdown`."""
        self._spinning = 0
        """How many calls of `spin` and similar methods are running."""
        self._polled = False
        """Whether the last call that returned work was one that does not wait."""
        self._context.on_end(self.wake)

    @property
    def is_spinning(self) -> bool:
        """Whether `spin` or `spin_until_future_complete` is running, as a method or as a function of `rclpy`."""
        return self._spinning > 0

    @contextmanager
    def _count_spinning(self) -> Generator[None]:
        self._spinning += 1
        try:
            yield
        finally:
            self._spinning -= 1

    @property
    def context(self) -> Context:
        """The context whose shutdown ends this executor's spinning."""
        return self._context

    def __enter__(self) -> Executor:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.shutdown()

    def arm(self, timer: Entity, deadline: int) -> None:
        """Set the steady time (ns) at which a timer is due; thread-safe."""
        self._timers.push(deadline, timer)
        if self._waiting:
            self._wakeup.set()

    def ask_again(self, entity: Entity) -> None:
        """Retry, at the next wake, an entity that may not begin now."""
        self._held.append(entity)

    def wake(self) -> None:
        """Wake a waiting `spin_once`."""
        self._wakeup.set()

    def add_node(self, node: NodeBase) -> bool:
        """Add a node, removing it from its previous executor; returns whether it was new here."""
        if node in self._nodes:
            return False
        self._nodes[node] = self._node_count
        self._node_count += 1
        node.executor = self
        if self._is_shutdown and not distribution().closed_executor_takes_work:
            raise AttributeError("this executor was shut down: it serves no more nodes")
        node._ros_attach(self, self._nodes[node])
        self.wake()
        return True

    def remove_node(self, node: NodeBase) -> None:
        """Remove a node; its `executor` still refers to this one, as upstream."""
        if self._nodes.pop(node, None) is not None:
            node._ros_detach()

    def get_nodes(self) -> list[NodeBase]:
        """Return the nodes of this executor."""
        return list(self._nodes)

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Shut down; returns whether running callbacks ended in time."""
        self._is_shutdown = True
        self.wake()
        for node in self.get_nodes():
            self.remove_node(node)
        return True

    def spin(self) -> None:
        """Run callbacks until shut down; raises `ExternalShutdownException` if its context is, between callbacks."""
        report_unused_overrides(self._context)
        with self._count_spinning():
            while self._context.ok() and not self._is_shutdown:
                self.spin_once()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Run one callback; a time-out of None or below zero waits for ever, 0 not at all."""
        raise NotImplementedError

    def spin_once_until_future_complete(self, future: Future[Any], timeout_sec: float | None = None) -> None:
        """Run one callback, or return when the future is done or cancelled."""
        future._when_settled(self.wake)
        self._spin_once(timeout_sec, future._settled)

    def spin_until_future_complete(self, future: Future[Any], timeout_sec: float | None = None) -> None:
        """Run callbacks until the future is done or cancelled, or the time-out (s) expires."""
        with self._count_spinning():
            self._spin_until(future, timeout_sec)

    def _spin_until(self, future: Future[Any], timeout_sec: float | None) -> None:
        future._when_settled(self.wake)
        timeout = timeout_sec_to_nsec(timeout_sec)
        start = self._clock.steady_ns()
        deadline = None if timeout < 0 else start + timeout
        warning = min(start + WARNING_DELAY_NS, deadline or math.inf) if runs_in_callback() else None
        while self._context.ok() and not future._settled() and not self._is_shutdown:
            ends = [each for each in (deadline, warning) if each is not None]
            self._spin_once(max(0, min(ends) - self._clock.steady_ns()) * 1e-9 if ends else None, future._settled)
            now = self._clock.steady_ns()
            if warning is not None and now >= warning:
                warning = None
                report_future(future, self)
            if deadline is not None and now >= deadline:
                return

    def _spin_once(self, timeout_sec: float | None, condition: Condition | None = None) -> None:
        raise NotImplementedError

    def _take(self, timeout_sec: float | None, condition: Condition | None, nodes: set[NodeBase] | None = None) -> Any:
        """Take the next entity, whose callback group it enters, or the next task; raises an exception if there is none.

        Raises `ValueError` if another thread is waiting for the same work (with the same `nodes`), as upstream's
        generator does.
        """
        asked = (timeout_sec, condition, nodes)
        timeout = -1 if timeout_sec is None else timeout_sec_to_nsec(timeout_sec)
        deadline = None if timeout < 0 else self._clock.steady_ns() + timeout
        batch, context = self._batch, self._context
        if self._polled:
            self._polled = False
            if timeout == 0 and not batch:  # as upstream, a poll after a wake's last callback only ends that wake
                raise TimeoutException
        if self._held:
            self._release_held()
        while True:
            while batch:
                try:
                    item = batch.popleft()
                except IndexError:  # another thread spins this executor too
                    break
                if item.__class__ is Task:
                    self._polled = timeout == 0
                    return item
                if item.sink is not self or not item.pending():
                    item.arm()  # for a timer whose clock was set back, so that it is due later
                    continue
                group = item.callback_group
                if (not group.own_rules or group.can_execute(item)) and group.beginning_execution(item):
                    self._polled = timeout == 0
                    return item
                group.block(item)
            if self._is_shutdown or context.ended or condition is not None:
                self._check_for_end(condition)
            if not self._new_batch():
                self._wait(deadline, asked)
                if self._held:
                    self._release_held()

    def _check_for_end(self, condition: Condition | None) -> None:
        """Raise the exception that ends the wait for work, if there is a reason to."""
        context = self._context
        if self._is_shutdown:
            raise ShutdownException
        if context.ended:
            current().deliver_signals()
            raise ShutdownException if self.is_global and not context.ended_by_signal else ExternalShutdownException
        if condition is not None and condition():
            raise ConditionReachedException

    def _release_held(self) -> None:
        held, self._held = self._held, []
        for entity in held:
            entity.refused()

    def _new_batch(self) -> bool:
        """Collect the ready entities and tasks into the batch; returns whether there are any."""
        ready, batch, timers = self._ready, self._batch, self._timers.entries
        now = self._steady_ns() if timers else 0
        due = bool(timers) and timers[0][0] <= now
        if not (due or ready or self._ready_tasks):  # the usual case before a wait
            return bool(batch)
        entities: list[Entity] = []
        if due:
            with self._lock:
                entities = self._timers.pop_due(now, self)
        while ready:
            entity = ready.popleft()
            entity.marked = None
            if entity.sink is self:
                entities.append(entity)
        if self._ready_tasks:
            batch.extend(self._collect_tasks())
        if len(entities) > 1:
            self._sort(entities)
        batch.extend(entities)
        return bool(batch)

    def _wait(self, deadline: int | None, asked: tuple[object, ...]) -> None:
        with self._lock:
            timer = self._timers.next_deadline(self)
        until = timer if deadline is None else deadline if timer is None else min(deadline, timer)
        wakeup, context = self._wakeup, self._context
        wakeup.clear()
        if self._awaited == asked:
            raise spun_twice()
        self._waiting += 1
        self._awaited = asked
        try:
            if self._ready or self._ready_tasks or self._is_shutdown or (context.ended and not context.ok()):
                return
            woken = wakeup.wait(until)
        finally:
            self._waiting -= 1
            if self._awaited is asked:
                self._awaited = None
        if not woken and deadline is not None and self._clock.steady_ns() >= deadline:
            raise TimeoutException

    def _run(self, item: Any) -> None:
        """Run an item that `_take` has returned; propagates exceptions of the callback."""
        if item.__class__ is Task:
            self._run_task(item)
            return
        try:
            result = item.run()
        except BaseException:
            self._ended(item)
            raise
        if result is None:
            self._ended(item)
            return
        # A coroutine: its group stays busy until the coroutine has ended.
        task: Task[Any] = Task(result, executor=self)
        with self._lock:
            self._tasks[task] = item
        self._run_task(task)

    def _ended(self, entity: Entity) -> None:
        group = entity.callback_group
        group.ending_execution(entity)
        if not entity.arms_itself and entity.pending():
            entity.notify()
        if group.blocked:
            group.unblock()


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that calls `spin`."""

    receives_in_one_thread = True

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Run one callback."""
        try:
            item = self._take(timeout_sec, None)
        except (ShutdownException, TimeoutException):
            return
        self._run(item)

    def _spin_once(self, timeout_sec: float | None, condition: Condition | None = None) -> None:
        try:
            item = self._take(timeout_sec, condition)
        except (ShutdownException, TimeoutException, ConditionReachedException):
            return
        self._run(item)


class MultiThreadedExecutor(Executor):
    """Runs callbacks in a pool of threads; an exception of a callback is raised at a later `spin_once`."""

    _sort = staticmethod(sort_longest_refused_first)

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        if num_threads is None:
            num_threads = cpu_count()
        if num_threads == 1:
            warnings.warn(
                "MultiThreadedExecutor is used with a single thread.\nUse the SingleThreadedExecutor instead.",
                stacklevel=2,
            )
        if num_threads <= 0:
            raise ValueError("max_workers must be greater than 0")
        self._pool = WorkerPool(num_threads, "executor")
        self._futures: deque[Task[Any]] = deque()
        self._wanted: tuple[Condition | None, Condition] = (None, lambda: bool(self._failed()))
        """A caller's condition, and the pool's condition made from it, which is reused while the first is equal."""
        report_unfetched_at_exit(self, self._futures)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Pass one callback to the pool."""
        self._spin_once(timeout_sec)

    def _spin_once(self, timeout_sec: float | None, condition: Condition | None = None) -> None:
        if self._wanted[0] != condition:
            self._wanted = (condition, lambda: bool(self._failed()) or (condition is not None and condition()))
        try:
            item = self._take(timeout_sec, self._wanted[1])
        except (ExternalShutdownException, ShutdownException, TimeoutException, ConditionReachedException):
            item = None
        if item is not None:
            item.refusals = 0
            done: Task[Any] = Task(self._run, (item,))
            done._when_settled(self.wake)
            self._futures.append(done)
            self._pool.submit(done)
        self._raise_failed()

    def _failed(self) -> list[Task[Any]]:
        return [each for each in list(self._futures) if each.done() and each._exception is not None]

    def _raise_failed(self) -> None:
        for each in list(self._futures):
            if each.done():
                self._futures.remove(each)
                each.result()

    def spin(self) -> None:
        """Run callbacks until shut down; returns silently if the context is shut down."""
        report_unused_overrides(self._context)
        with self._count_spinning():
            while self._context.ok() and not self._is_shutdown:
                self.spin_once()

    def shutdown(self, timeout_sec: float | None = None, *, wait_for_threads: bool = True) -> bool:
        """Shut down, and wait for the pool's threads to end unless told not to."""
        result = super().shutdown(timeout_sec)
        self._pool.shutdown(wait=wait_for_threads)
        return result


__getattr__ = reexporting(
    __name__,
    "Client Clock ClockType Context GuardCondition InvalidHandle NumberOfEntities Service Subscription Timer Waitable",
)
