"""Locks of a stepped run."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any
from unittest.mock import Mock

import pytest
from bot_console.runtime.process import NodeProcess, stepped
from bot_console.runtime.process.stepping import lock as module

OBSOLETE = {"acquire_lock", "locked_lock", "release_lock"}
"""Synonyms of a lock's methods from Python 2."""


@pytest.mark.parametrize(
    ("stepped_lock", "built_in"), [(module.SteppedLock(), threading.Lock()), (module.SteppedRLock(), threading.RLock())]
)
def test_lock_has_all_methods_of_the_built_in_one(stepped_lock: Any, built_in: Any) -> None:
    """`concurrent.futures`, `logging` and `multiprocessing` call some methods that are not public."""
    assert set(dir(built_in)) - OBSOLETE <= set(dir(stepped_lock))


def test_lock_is_free_in_a_forked_child_that_lacks_its_holder() -> None:
    lock = module.SteppedLock()
    lock.acquire()
    lock._waiters.append(Mock())
    lock._at_fork_reinit()
    assert lock.acquire(False) and not lock._waiters


def test_recursive_lock_counts_its_levels() -> None:
    lock = module.SteppedRLock()
    if not hasattr(threading.RLock(), "_recursion_count"):
        pytest.skip("new in Python 3.11")
    with lock, lock:
        assert lock._recursion_count() == 2


class InterruptedLock:
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

    lock._lock = InterruptedLock(lock._lock, finalizer)
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
