"""Locks of a stepped run."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from bot_console.runtime.process import NodeProcess, stepped
from bot_console.runtime.process.stepping import lock as module


class Interrupted:
    """A built-in lock that runs a function in the same thread once, right after it was acquired."""

    def __init__(self, lock: Any, finalizer: Callable[[], None]) -> None:
        self._lock = lock
        self._finalizers = [finalizer]

    def acquire(self, *how: Any) -> bool:
        taken = self._lock.acquire(*how)
        while self._finalizers:
            self._finalizers.pop()()
        return taken

    def __getattr__(self, name: str) -> Any:
        return getattr(self._lock, name)


def test_finalizer_may_take_a_lock_during_its_acquisition() -> None:
    """Like the built-in lock, it has no intermediate state in which it is taken but has no owner."""
    lock = module.SteppedRLock()
    taken: list[bool] = []

    def finalizer() -> None:
        taken.append(lock.acquire(False))
        lock.release()

    lock._lock = Interrupted(lock._lock, finalizer)
    lock.acquire()
    lock.release()
    assert taken == [True]
    assert not lock.locked()


def test_condition_releases_all_levels_and_reacquires_them() -> None:
    message: list[str] = []
    with stepped() as clock:

        def run() -> None:
            condition = threading.Condition()

            def other() -> None:
                with condition:
                    message.append("other")
                    condition.notify()

            with condition, condition:
                threading.Thread(target=other).start()
                condition.wait()
                message.append("woken")
            message.append("done")

        process = NodeProcess("n", clock)
        process.start(run)
        assert process.wait(5.0) == 0
    assert message == ["other", "woken", "done"]


def test_only_the_owner_may_release() -> None:
    lock = module.SteppedRLock()
    lock.acquire()
    failures: list[type[BaseException]] = []

    def other() -> None:
        try:
            lock.release()
        except RuntimeError as error:
            failures.append(type(error))

    thread = threading.Thread(target=other)
    thread.start()
    thread.join()
    assert failures == [RuntimeError]
    assert lock.locked()
