"""Locks of a stepped run."""

from __future__ import annotations

import sys
import threading

from bot_console.runtime.process import NodeProcess, stepped
from bot_console.runtime.process import stepped_lock as module


def test_a_finalizer_may_take_a_lock_that_its_thread_is_just_taking() -> None:
    """As the built-in lock's, the acquisition has no middle in which the lock is taken and the owner is not known."""
    lock = module.SteppedRLock()
    refused: list[int] = []

    def finalizer(frame, event, _argument):
        if event == "line":
            sys.settrace(None)
            if lock.acquire(False):
                lock.release()
            else:
                refused.append(frame.f_lineno)
            sys.settrace(trace)
        return finalizer

    def trace(frame, _event, _argument):
        return finalizer if frame.f_code.co_filename == module.__file__ else None

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        lock.acquire()
        lock.acquire()
        lock.release()
        lock.release()
    finally:
        sys.settrace(before)
    assert refused == []
    assert not lock.locked()


def test_a_condition_gives_all_levels_back_and_takes_them_again() -> None:
    said: list[str] = []
    with stepped() as clock:

        def run() -> None:
            condition = threading.Condition()

            def other() -> None:
                with condition:
                    said.append("other")
                    condition.notify()

            with condition, condition:
                threading.Thread(target=other).start()
                condition.wait()
                said.append("woken")
            said.append("done")

        process = NodeProcess("n", clock)
        process.start(run)
        assert process.wait(5.0) == 0
    assert said == ["other", "woken", "done"]


def test_only_the_owner_gives_it_back() -> None:
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
