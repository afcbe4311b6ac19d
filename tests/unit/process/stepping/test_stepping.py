"""Stepped time: one thread runs at a time, in a fixed order, and time jumps when all wait."""

from __future__ import annotations

import random
import threading
import time

from bot_console.runtime.process import MAIN, NodeProcess, RealTime, current, stepped
from bot_console.runtime.process.stepping.scheduler import INSTANT_WAITS, POLL_NS
from bot_console.runtime.process.stepping.stepped_time import DEFAULT_START_NS, FREE_READS
from bot_console.runtime.process.virtual.install import uninstall_virtual_process
from ticking import ticker

SECOND = 10**9
LONG = 240.0


def test_time_advances_only_when_run(clock):
    assert (clock.steady_ns(), clock.system_ns()) == (0, DEFAULT_START_NS)
    clock.run_for(1.5)
    assert (clock.steady_ns(), clock.system_ns()) == (SECOND * 3 // 2, DEFAULT_START_NS + SECOND * 3 // 2)
    clock.run_until(2 * SECOND)
    clock.run_until(SECOND)
    assert clock.steady_ns() == 2 * SECOND


def test_run_includes_everything_up_to_its_end(clock):
    trace = []
    NodeProcess("a", clock).start(ticker(trace, "a", 0.5, 10))
    assert trace == []
    clock.run_for(1.0)
    assert trace == [(SECOND // 2, "a"), (SECOND, "a")]


def test_simultaneous_timers_fire_in_order_of_creation(clock):
    trace = []
    for name in "abc":
        NodeProcess(name, clock).start(ticker(trace, name, 1.0, 2))
    clock.run_for(2.0)
    assert [name for _time, name in trace] == list("abcabc")


def test_ready_threads_run_in_order_of_becoming_ready(clock):
    order = []
    addresses = {name: clock.wakeup() for name in "abc"}

    def wait_at(name):
        def run():
            addresses[name].wait()
            order.append(name)

        return run

    for name in "abc":
        NodeProcess(name, clock).start(wait_at(name))
    clock.run_for(0)
    for name in "cab":
        addresses[name].set()
    assert order == []
    clock.run_for(0)
    assert order == list("cab")


def test_wait_returns_whether_it_was_set_or_timed_out(clock):
    results = []
    address = clock.wakeup()

    def target():
        results.append((address.wait(SECOND), current().clock.steady_ns()))
        results.append((address.wait(5 * SECOND), current().clock.steady_ns()))
        address.clear()
        results.append((address.wait(6 * SECOND), address.is_set()))

    NodeProcess("n", clock).start(target)
    clock.run_for(3.0)
    address.set()
    clock.run_for(10.0)
    assert results == [(False, SECOND), (True, 3 * SECOND), (False, False)]


def test_time_module_reports_virtual_time_in_nodes(clock):
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


def test_real_time_is_restored_afterwards():
    before = (time.time, time.sleep, time.monotonic, MAIN.clock)
    with stepped():
        assert time.time() == DEFAULT_START_NS * 1e-9
    uninstall_virtual_process()
    assert (time.time, time.sleep, time.monotonic, MAIN.clock) == before
    assert isinstance(MAIN.clock, RealTime)


def test_without_virtual_main_only_nodes_have_virtual_time():
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


def test_polling_advances_time(clock):
    polls = []

    def target():
        address = current().clock.wakeup()
        while time.monotonic_ns() < 100 * POLL_NS:
            address.wait(time.monotonic_ns())
            polls.append(1)
        time.sleep(0)

    process = NodeProcess("poller", clock)
    process.start(target)
    assert process.wait(1.0) == 0
    assert len(polls) == 100


def test_loop_that_reads_the_clock_ends(clock):
    def target():
        while time.time_ns() < DEFAULT_START_NS + SECOND // 100:
            pass

    process = NodeProcess("reader", clock)
    process.start(target)
    assert process.wait(1.0) == 0
    assert FREE_READS > 1000


def test_nodes_that_keep_waking_each_other_do_not_stop_time(clock):
    addresses = clock.wakeup(), clock.wakeup()
    turns = []

    def player(mine, other):
        def run():
            while True:
                mine.wait()
                mine.clear()
                turns.append(1)
                other.set()

        return run

    NodeProcess("a", clock).start(player(*addresses))
    NodeProcess("b", clock).start(player(*reversed(addresses)))
    addresses[0].set()
    clock.run_for(POLL_NS * 1e-9 * 100)
    assert len(turns) > INSTANT_WAITS // 2


def test_idle_run_jumps_to_its_end(clock):
    NodeProcess("n", clock).start(lambda: clock.wakeup().wait())
    clock.run_for(1e6)
    assert clock.steady_ns() == 10**15


def test_random_numbers_are_seeded_and_restored():
    before = random.getstate()

    def draw(seed):
        with stepped(seed=seed):
            return random.random()

    assert draw(1) == draw(1) != draw(2)
    assert random.getstate() == before


def test_node_may_start_processes(clock):
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


def test_cancelled_timers_do_not_accumulate(clock):
    address = clock.wakeup()

    def target():
        for number in range(10_000):
            address.wait(SECOND * 1000 + number)
            address.clear()

    def waker():
        for _ in range(10_000):
            address.set()
            time.sleep(0.001)

    NodeProcess("n", clock).start(target)
    NodeProcess("w", clock).start(waker)
    clock.run_for(9.0)
    assert len(clock._scheduler._deadlines) < 200
