"""Stepped time: one thread at a time, in a fixed order, and time jumps when all wait."""

from __future__ import annotations

import queue
import random
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext, suppress

import pytest
from bot_console.runtime.process import MAIN, NodeProcess, RealTime, current, on_notice, stepped
from bot_console.runtime.process.baton import INSTANT_WAITS, POLL_NS
from bot_console.runtime.process.stepping import DEFAULT_START_NS, FREE_READS
from bot_console.runtime.process.virtual import uninstall_virtual_process

SECOND = 10**9
LONG = 20.0


@pytest.fixture
def clock():
    with stepped() as clock:
        yield clock
    uninstall_virtual_process()


def ticker(trace, name, period, count):
    def run():
        for _ in range(count):
            time.sleep(period)
            trace.append((current().clock.steady_ns(), name))

    return run


def test_time_stands_still_until_it_is_run(clock):
    assert (clock.steady_ns(), clock.system_ns()) == (0, DEFAULT_START_NS)
    clock.run_for(1.5)
    assert (clock.steady_ns(), clock.system_ns()) == (SECOND * 3 // 2, DEFAULT_START_NS + SECOND * 3 // 2)
    clock.run_until(2 * SECOND)
    clock.run_until(SECOND)
    assert clock.steady_ns() == 2 * SECOND


def test_everything_up_to_the_end_of_the_run_happens(clock):
    trace = []
    NodeProcess("a", clock).start(ticker(trace, "a", 0.5, 10))
    assert trace == []
    clock.run_for(1.0)
    assert trace == [(SECOND // 2, "a"), (SECOND, "a")]


def test_same_time_means_order_of_creation(clock):
    trace = []
    for name in "abc":
        NodeProcess(name, clock).start(ticker(trace, name, 1.0, 2))
    clock.run_for(2.0)
    assert [name for _time, name in trace] == list("abcabc")


def test_order_of_becoming_ready(clock):
    order = []
    doors = {name: clock.wakeup() for name in "abc"}

    def wait_at(name):
        def run():
            doors[name].wait()
            order.append(name)

        return run

    for name in "abc":
        NodeProcess(name, clock).start(wait_at(name))
    clock.run_for(0)
    for name in "cab":
        doors[name].set()
    assert order == []
    clock.run_for(0)
    assert order == list("cab")


def test_a_wait_tells_whether_it_was_set_or_timed_out(clock):
    results = []
    door = clock.wakeup()

    def target():
        results.append((door.wait(SECOND), current().clock.steady_ns()))
        results.append((door.wait(5 * SECOND), current().clock.steady_ns()))
        door.clear()
        results.append((door.wait(6 * SECOND), door.is_set()))

    NodeProcess("n", clock).start(target)
    clock.run_for(3.0)
    door.set()
    clock.run_for(10.0)
    assert results == [(False, SECOND), (True, 3 * SECOND), (False, False)]


def test_the_time_module_tells_virtual_time_in_nodes(clock):
    seen = []

    def target():
        start = (time.time(), time.monotonic(), time.perf_counter(), time.time_ns(), time.monotonic_ns())
        time.sleep(0.25)
        seen.append(start)
        seen.append((time.time(), time.monotonic(), time.perf_counter(), time.time_ns(), time.monotonic_ns()))
        seen.append((time.gmtime().tm_year, time.gmtime(0).tm_year, time.ctime(0) == time.ctime(0.0)))

    NodeProcess("n", clock).start(target)
    clock.run_for(1.0)
    epoch = DEFAULT_START_NS
    assert seen[0] == (epoch * 1e-9, 0.0, 0.0, epoch, 0)
    assert seen[1] == ((epoch + SECOND // 4) * 1e-9, 0.25, 0.25, epoch + SECOND // 4, SECOND // 4)
    assert seen[2] == (2023, 1970, True)


def test_real_time_is_back_afterwards():
    before = (time.time, time.sleep, time.monotonic, MAIN.clock)
    with stepped():
        assert time.time() == DEFAULT_START_NS * 1e-9
    uninstall_virtual_process()
    assert (time.time, time.sleep, time.monotonic, MAIN.clock) == before
    assert isinstance(MAIN.clock, RealTime)


def test_without_virtual_main_only_the_clock_is_virtual():
    with stepped(virtual_main=False) as clock:
        assert time.time() > DEFAULT_START_NS * 1e-9
        thread = threading.Thread(target=lambda: None)
        thread.start()
        thread.join(LONG)
        assert not thread.is_alive()
        trace = []
        NodeProcess("n", clock).start(ticker(trace, "n", 1.0, 5))
        clock.sleep_until(2 * SECOND)
        assert len(trace) == 2


def test_the_driver_waits_as_the_nodes_do(clock):
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


def test_threads_and_pools_and_conditions_of_a_node(clock):
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


def test_polls_move_time(clock):
    polls = []

    def target():
        door = current().clock.wakeup()
        while time.monotonic_ns() < 100 * POLL_NS:
            door.wait(time.monotonic_ns())
            polls.append(1)
        time.sleep(0)

    process = NodeProcess("poller", clock)
    process.start(target)
    assert process.wait(1.0) == 0
    assert len(polls) == 100


def test_a_loop_that_reads_the_clock_ends(clock):
    def target():
        while time.time_ns() < DEFAULT_START_NS + SECOND // 100:
            pass

    process = NodeProcess("reader", clock)
    process.start(target)
    assert process.wait(1.0) == 0
    assert FREE_READS > 1000


def test_nodes_that_keep_each_other_awake_do_not_stop_time(clock):
    doors = clock.wakeup(), clock.wakeup()
    turns = []

    def player(mine, other):
        def run():
            while True:
                mine.wait()
                mine.clear()
                turns.append(1)
                other.set()

        return run

    NodeProcess("a", clock).start(player(*doors))
    NodeProcess("b", clock).start(player(*reversed(doors)))
    doors[0].set()
    clock.run_for(POLL_NS * 1e-9 * 100)
    assert len(turns) > INSTANT_WAITS // 2


def test_idle_jumps_to_the_end(clock):
    NodeProcess("n", clock).start(lambda: clock.wakeup().wait())
    clock.run_for(1e6)
    assert clock.steady_ns() == 10**15


def test_signals_in_virtual_time(clock):
    order = []

    def target():
        try:
            time.sleep(1000)
        except KeyboardInterrupt:
            order.append(time.monotonic())
            raise

    process = NodeProcess("n", clock)
    process.start(target, stderr=order.append)
    clock.run_for(2.0)
    process.interrupt()
    assert process.wait(1.0) == -2
    assert order[0] == 2.0
    assert order[-1] == "KeyboardInterrupt\n"


def test_stop_escalates_in_virtual_time(clock):
    def target():
        current().on_interrupt(lambda signum: None)
        while True:
            with suppress(KeyboardInterrupt):
                time.sleep(1000)

    process = NodeProcess("n", clock)
    process.start(target)
    clock.run_for(0)
    assert process.stop(grace=5.0) == -9
    assert time.monotonic() == 10.0


def test_kill_lets_it_unwind_without_time_passing(clock):
    unwound = []

    def target():
        try:
            time.sleep(1000)
        finally:
            unwound.append(time.monotonic())

    process = NodeProcess("n", clock)
    process.start(target)
    clock.run_for(1.0)
    process.kill()
    assert process.exit_code == -9
    clock.run_for(1.0)
    assert unwound == [1.0]


def test_closing_ends_what_still_runs():
    ended = threading.Event()

    def target():
        try:
            time.sleep(1000)
        finally:
            ended.set()

    with stepped() as clock:
        process = NodeProcess("n", clock)
        process.start(target)
        clock.run_for(1.0)
    assert ended.is_set()
    assert process.exit_code == -9


def test_what_blocks_past_the_clock_is_named_and_others_go_on():
    notices = []
    remove = on_notice(lambda process, text: notices.append((process.name, text)))
    lock = threading.Lock()
    lock.acquire()
    trace = []

    def blocker():
        lock.acquire()  # the stepped run cannot see this
        time.sleep(1.0)
        trace.append("blocker")

    line = blocker.__code__.co_firstlineno + 1
    with stepped(stall_s=0.02) as clock:
        stuck = NodeProcess("stuck", clock)
        stuck.start(blocker)
        NodeProcess("other", clock).start(ticker(trace, "other", 0.1, 3))
        clock.run_for(0.3)
        assert [name for _time, name in trace] == ["other"] * 3
        assert not clock.deterministic
        assert len(clock.stalls) == 1 and f"{__file__}:{line}, in blocker" in clock.stalls[0]
        lock.release()
    remove()
    assert notices[0][0] == "stuck" and f"{__file__}:{line}" in notices[0][1]


def test_a_detached_thread_takes_turns_again():
    release = threading.Lock()
    release.acquire()
    trace = []

    def blocker():
        release.acquire()
        time.sleep(1.0)
        trace.append(current().clock.steady_ns())

    with stepped(stall_s=0.02) as clock:
        stuck = NodeProcess("stuck", clock)
        stuck.start(blocker, stderr=lambda line: None)
        clock.run_for(0.3)
        release.release()
        while stuck.main_state.waits == 0:
            pass
        clock.run_for(2.0)
    assert trace == [1_300_000_000]


def test_outside_threads_may_wake_and_wait():
    woken = []
    with stepped(virtual_main=False) as clock:
        door, answer = clock.wakeup(), clock.wakeup()

        def node():
            door.wait()
            answer.set()

        def outside():
            door.set()
            woken.append(answer.wait())

        NodeProcess("n", clock).start(node)
        thread = threading.Thread(target=outside, daemon=True)
        thread.start()
        while thread.is_alive():
            clock.run_for(0.001)
    assert woken == [True]


def test_participate():
    trace = []
    with stepped(virtual_main=False) as clock:

        def outside():
            with clock.participate():
                for _ in range(2):
                    time.sleep(1.0)
                    trace.append(time.monotonic())

        thread = threading.Thread(target=outside, daemon=True)
        thread.start()
        while thread.is_alive():
            clock.run_for(1.0)
    assert trace[1] - trace[0] == 1.0


def test_only_who_takes_part_can_run(clock):
    errors = []

    def outside():
        try:
            clock.run_for(1.0)
        except RuntimeError as error:
            errors.append(str(error))

    thread = threading.Thread(target=outside)
    from bot_console.runtime.process.child_threads import start_outside

    start_outside(thread)
    thread.join(LONG)
    assert errors == ["this thread takes no part in the stepped run: see SteppedTime.participate"]


def test_random_numbers_are_seeded_and_restored():
    before = random.getstate()

    def draw(seed):
        with stepped(seed=seed):
            return random.random()

    assert draw(1) == draw(1) != draw(2)
    assert random.getstate() == before


def test_starting_processes_from_a_node(clock):
    trace = []

    def mother():
        time.sleep(1.0)
        child = NodeProcess("child", clock)
        child.start(ticker(trace, "child", 1.0, 2))
        child.wait()
        trace.append(time.monotonic())

    process = NodeProcess("mother", clock)
    process.start(mother)
    assert process.wait(10) == 0
    assert trace == [(2 * SECOND, "child"), (3 * SECOND, "child"), 3.0]


def test_many_timers_leave_no_heap(clock):
    door = clock.wakeup()

    def target():
        for number in range(10_000):
            door.wait(SECOND * 1000 + number)
            door.clear()

    def waker():
        for _ in range(10_000):
            door.set()
            time.sleep(0.001)

    NodeProcess("n", clock).start(target)
    NodeProcess("w", clock).start(waker)
    clock.run_for(9.0)
    assert len(clock._baton._timers) < 200


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


def test_an_interrupted_wait_for_a_lock_passes_the_turn_on(clock):
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


def test_conditions_on_locks_of_the_run(clock):
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
