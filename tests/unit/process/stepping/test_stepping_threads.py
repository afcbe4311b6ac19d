"""Stepped time: which threads take part, and what they wait for: each other, locks, conditions, pools."""

from __future__ import annotations

import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext

import pytest
from bot_console.runtime.process import NodeProcess, current, stepped
from ticking import ticker

SECOND = 10**9
LONG = 240.0


def test_driver_waits_as_nodes_do(clock):
    box = queue.Queue()

    def target():
        for number in range(3):
            time.sleep(1.0)
            box.put(number)

    process = NodeProcess("n", clock)
    process.start(target)
    assert [box.get(), box.get(timeout=5)] == [0, 1]
    assert time.monotonic() == 2.0
    with pytest.raises(queue.Empty):
        box.get(timeout=0.5)
    assert time.monotonic() == 2.5
    time.sleep(0.1)
    assert process.wait(10) == 0
    assert time.monotonic() == 3.0


def test_threads_of_the_driver_take_part(clock):
    trace = []
    threads = [threading.Thread(target=ticker(trace, name, 1.0, 2)) for name in "ab"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert trace == [(SECOND, "a"), (SECOND, "b"), (2 * SECOND, "a"), (2 * SECOND, "b")]
    assert not any(thread.is_alive() for thread in threads)


def test_threads_pools_and_conditions_of_a_node_take_part(clock):
    trace = []

    def target():
        with ThreadPoolExecutor(3) as pool:
            futures = [pool.submit(ticker(trace, name, 1.0, 1)) for name in "abc"]
            assert all(future.result(timeout=5) is None for future in futures)
        trace.append(threading.Event().wait(0.5))
        semaphore = threading.Semaphore(0)
        trace.append(semaphore.acquire(timeout=0.5))
        barrier = threading.Barrier(2)
        threading.Timer(1.0, barrier.wait).start()
        trace.append(barrier.wait(5) in (0, 1))
        trace.append(time.monotonic())

    process = NodeProcess("n", clock)
    process.start(target)
    assert process.wait(100) == 0
    assert trace == [(SECOND, "a"), (SECOND, "b"), (SECOND, "c"), False, False, True, 3.0]
    assert clock.deterministic


def test_outside_threads_may_wake_and_wait():
    woken = []
    with stepped(virtual_main=False) as clock:
        address, answer = clock.wakeup(), clock.wakeup()

        def node():
            address.wait()
            answer.set()

        def outside():
            address.set()
            woken.append(answer.wait())

        NodeProcess("n", clock).start(node)
        thread = threading.Thread(target=outside, daemon=True)
        thread.start()
        while thread.is_alive():
            clock.run_for(0.001)
    assert woken == [True]


def test_outside_threads_cannot_run_the_clock(clock):
    errors = []

    def outside():
        try:
            clock.run_for(1.0)
        except RuntimeError as error:
            errors.append(str(error))

    thread = threading.Thread(target=outside)
    from bot_console.runtime.process.virtual.child_threads import start_outside

    start_outside(thread)
    thread.join(LONG)
    assert errors == ["this thread takes no part in the stepped run"]


def test_locks_are_handed_over_in_order_and_in_virtual_time(clock):
    trace = []
    lock = threading.Lock()
    reentrant = threading.RLock()

    def target(name, guard):
        def run():
            with guard, guard if guard is reentrant else nullcontext():
                time.sleep(1.0)
                trace.append((time.monotonic(), name))

        return run

    for guard in (lock, reentrant):
        for name in "abc":
            NodeProcess(name, clock).start(target(name, guard))
    clock.run_for(0.5)
    assert lock.locked()
    assert not lock.acquire(blocking=False)
    assert not lock.acquire(timeout=0.25)
    assert time.monotonic() == 0.75
    clock.run_for(10)
    assert trace == [(1.0, "a"), (1.0, "a"), (2.0, "b"), (2.0, "b"), (3.0, "c"), (3.0, "c")]
    assert clock.deterministic
    assert lock.acquire() and not lock.acquire(False)
    lock.release()
    with pytest.raises(RuntimeError):
        lock.release()
    with pytest.raises(RuntimeError, match="cannot release un-acquired lock"):
        reentrant.release()


def test_interrupted_wait_for_a_lock_passes_it_on(clock):
    lock = threading.Lock()
    got = []

    def target():
        with lock:
            got.append(current().name)

    lock.acquire()
    first, second = NodeProcess("first", clock), NodeProcess("second", clock)
    for process in (first, second):
        process.start(target, stderr=lambda line: None)
    clock.run_for(1.0)
    lock.release()
    first.interrupt()
    clock.run_for(1.0)
    assert (first.exit_code, second.exit_code) == (-2, 0)
    assert got == ["second"]


def test_conditions_work_on_stepped_locks(clock):
    condition = threading.Condition()
    seen = []

    def waiter():
        with condition, condition:
            seen.append(condition.wait(5.0))
            seen.append(condition.wait_for(lambda: len(seen) > 5, timeout=2.0))

    process = NodeProcess("n", clock)
    process.start(waiter)
    clock.run_for(1.0)
    with condition:
        condition.notify()
    assert process.wait(10) == 0
    assert seen == [True, False]
    assert time.monotonic() == 3.0
