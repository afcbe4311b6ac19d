"""Futures, and tasks that run a function or a coroutine in an executor."""

from __future__ import annotations

import sys
import threading
import warnings
import weakref
from collections.abc import Callable, Coroutine, Generator, Iterable, Mapping
from typing import Any, Generic, Protocol, TypeVar, cast

from rclpy.impl.callables import is_coroutine, is_coroutine_function

T = TypeVar("T")

_running = threading.local()
"""`task` is the task that the thread is running; a future that it awaits registers itself there."""


class TaskExecutor(Protocol):
    """What a future needs of an executor."""

    def create_task(self, callback: Callable[..., object], *args: object) -> object:
        """Schedule a function in the executor."""


class Future(Generic[T]):
    """A result that arrives later. Done callbacks run as tasks of the executor, or at once if there is none."""

    def __init__(self, *, executor: TaskExecutor | None = None) -> None:
        self._done = False
        self._cancelled = False
        self._result: T | None = None
        self._exception: BaseException | None = None
        self._exception_fetched = False
        self._callbacks: list[Callable[[Future[T]], object]] = []
        self._waiters: list[Callable[[], object]] = []
        self._lock = threading.Lock()
        self._executor: weakref.ref[TaskExecutor] | None = None
        self._set_executor(executor)

    def __del__(self) -> None:
        self.report_unfetched()

    def report_unfetched(self) -> None:
        """Print the exception, if there is one that was never retrieved; does so only once."""
        if getattr(self, "_exception", None) is not None and not self._exception_fetched:
            self._exception_fetched = True
            print(f"The following exception was never retrieved: {self._exception}", file=sys.stderr)

    def __await__(self) -> Generator[None, None, T]:
        while not self._settled():
            task = getattr(_running, "task", None)
            if task is not None:
                task.waits_for = self
            yield
        return self.result()

    def cancel(self) -> None:
        """Cancel the future unless it is done; the code that awaits it continues with None."""
        with self._lock:
            if not self._done:
                self._cancelled = True
        self._settle()

    def cancelled(self) -> bool:
        """Whether it was cancelled."""
        return self._cancelled

    def done(self) -> bool:
        """Whether there is a result or an exception."""
        return self._done

    def _settled(self) -> bool:
        """Whether the future is done or cancelled."""
        return self._done or self._cancelled

    def result(self) -> T:
        """Return the result, or None while there is none; raises the exception if there is one."""
        if self._exception:
            raise self.exception()  # type: ignore[misc] -- there is one here
        return cast("T", self._result)  # None is not declared, as programs ask when the future is done

    def exception(self) -> BaseException | None:
        """Return the exception, or None."""
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: T) -> None:
        """Set the result."""
        with self._lock:
            self._result = result
            self._done = True
            self._cancelled = False
        self._settle()

    def set_exception(self, exception: BaseException) -> None:
        """Set an exception instead of a result."""
        with self._lock:
            self._exception = exception
            self._exception_fetched = False
            self._done = True
            self._cancelled = False
        self._settle()

    def add_done_callback(self, callback: Callable[[Future[T]], object]) -> None:
        """Add a callback that gets this future when it is done or cancelled, or at once if it already is."""
        with self._lock:
            if not self._settled():
                self._callbacks.append(callback)
                return
        executor = self._executor() if self._executor else None
        if executor is not None:
            executor.create_task(callback, self)
        else:
            callback(self)

    def remove_done_callback(self, callback: Callable[[Future[T]], object]) -> bool:
        """Remove one occurrence of a callback; returns whether there was one."""
        with self._lock:
            if callback not in self._callbacks:
                return False
            self._callbacks.remove(callback)
            return True

    def _set_executor(self, executor: TaskExecutor | None) -> None:
        self._executor = None if executor is None else weakref.ref(executor)

    def _when_settled(self, wake: Callable[[], object]) -> None:
        """Call `wake` once, from any thread, when the future is done or cancelled, or at once if it already is.

        A `wake` that is registered again while it waits, by a program that polls a future, is still called only once.
        """
        with self._lock:
            if not self._settled():
                if wake not in self._waiters:
                    self._waiters.append(wake)
                return
        wake()

    def _settle(self) -> None:
        with self._lock:
            callbacks, self._callbacks = self._callbacks, []
            waiters, self._waiters = self._waiters, []
        executor = self._executor() if self._executor else None
        for callback in callbacks:
            if executor is not None:
                executor.create_task(callback, self)
            else:
                self._call(callback)
        for wake in waiters:
            wake()

    def _call(self, callback: Callable[[Future[T]], object]) -> None:
        try:
            callback(self)
        except Exception as error:  # an exception of a done callback must not reach the code that completed the future
            warnings.warn(f"Unhandled exception in done callback: {error}", stacklevel=2)


class Task(Future[T]):
    """A function or coroutine that an executor runs; calling the task runs it up to its next wait."""

    def __init__(
        self,
        handler: Callable[..., object] | Coroutine[object, None, T],
        args: Iterable[object] | None = None,
        kwargs: Mapping[str, object] | None = None,
        executor: TaskExecutor | None = None,
    ) -> None:
        super().__init__(executor=executor)
        self._args = args or ()
        self._kwargs = kwargs or {}
        self._handler: Any = handler
        if is_coroutine_function(handler):
            self._handler = handler(*self._args, **self._kwargs)
            self._args, self._kwargs = (), {}
        self._executing = False
        self._task_lock = threading.Lock()
        self.waits_for: Future[Any] | None = None

    def __call__(self) -> None:
        """Run until the next wait, or to the end; a cancelled task does not run."""
        if self._settled() or self._executing or not self._task_lock.acquire(blocking=False):
            return
        try:
            if self._settled() or self._handler is None:
                return
            self._executing = True
            if is_coroutine(self._handler):
                self._step()
            else:
                self._run()
        finally:
            self._executing = False
            self._task_lock.release()

    def _step(self) -> None:
        try:
            self.waits_for = None
            outer, _running.task = getattr(_running, "task", None), self
            try:
                self._handler.send(None)
            finally:
                _running.task = outer
        except StopIteration as stop:
            self._handler = None
            self.set_result(stop.value)
        except Exception as error:  # boundary of a user callback: the executor raises it out of spin
            self.set_exception(error)
        except BaseException:  # KeyboardInterrupt etc. go to the thread that runs the task, which gets no result
            self._handler = None
            raise

    def _run(self) -> None:
        try:
            self.set_result(self._handler(*self._args, **self._kwargs))
        except Exception as error:  # boundary of a user callback, as above
            self.set_exception(error)
        self._handler, self._args, self._kwargs = None, (), {}

    def executing(self) -> bool:
        """Whether the task is running."""
        return self._executing

    def cancel(self) -> None:
        """Cancel the task: a coroutine is closed, a function that has not started does not run.

        Raises ValueError if the coroutine is running.
        """
        if is_coroutine(self._handler):
            self._handler.close()
            self._handler = None
        super().cancel()
