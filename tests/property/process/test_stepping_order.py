"""Whatever threads do, a stepped run gives the same trace, runs one thread at a time, and its time only increases."""

from __future__ import annotations

import queue
import threading
import time

from bot_console.runtime.process import NodeProcess, stepped
from hypothesis import given
from hypothesis import strategies as st

GATES = 3
durations = st.integers(0, 5).map(lambda tenths: tenths / 10)
address = st.integers(0, GATES - 1)
operation = st.one_of(
    st.tuples(st.just("sleep"), durations),
    st.tuples(st.just("set"), address),
    st.tuples(st.just("wait"), address, durations),
    st.tuples(st.just("put"), st.integers(0, 9)),
    st.tuples(st.just("get"), durations),
    st.tuples(st.just("event set"), address),
    st.tuples(st.just("event wait"), address, durations),
    st.tuples(st.just("spawn"), st.lists(st.tuples(st.just("sleep"), durations), max_size=3)),
)
programs = st.lists(st.lists(operation, max_size=8), min_size=1, max_size=5)


class Run:
    """One run of a program, and the events in it."""

    def __init__(self, threads):
        self.trace = []
        self.inside = 0
        with stepped() as self.clock:
            self.addresses = [self.clock.wakeup() for _ in range(GATES)]
            self.events = [threading.Event() for _ in range(GATES)]
            self.box = queue.Queue()
            processes = [NodeProcess(f"p{number}", self.clock) for number in range(len(threads))]
            for process, operations in zip(processes, threads, strict=True):
                process.start(lambda name=process.name, operations=operations: self.perform(name, operations))
            for seconds in (0.05, 0.25, 1.0, 100.0):
                self.clock.run_for(seconds)
                self.trace.append((self.clock.steady_ns(), "driver", [process.exit_code for process in processes]))
            self.deterministic = self.clock.deterministic

    def perform(self, name, operations):
        for operation in operations:
            self.inside += 1
            assert self.inside == 1
            self.trace.append((time.monotonic_ns(), name, operation))
            self.inside -= 1
            result = getattr(self, operation[0].replace(" ", "_"))(name, *operation[1:])
            self.trace.append((time.monotonic_ns(), name, result))

    def sleep(self, name, seconds):
        time.sleep(seconds)

    def set(self, name, number):
        self.addresses[number].set()

    def wait(self, name, number, seconds):
        woken = self.addresses[number].wait(time.monotonic_ns() + int(seconds * 1e9))
        self.addresses[number].clear()
        return woken

    def put(self, name, item):
        self.box.put(item)

    def get(self, name, seconds):
        try:
            return self.box.get(timeout=seconds)
        except queue.Empty:
            return "empty"

    def event_set(self, name, number):
        self.events[number].set()

    def event_wait(self, name, number, seconds):
        return self.events[number].wait(seconds)

    def spawn(self, name, operations):
        thread = threading.Thread(target=self.perform, args=(f"{name}.child", operations))
        thread.start()
        thread.join()
        return thread.is_alive()


@given(programs)
def test_the_same_program_gives_the_same_trace(threads):
    first, second = Run(threads), Run(threads)
    assert first.trace == second.trace
    assert first.deterministic
    times = [entry[0] for entry in first.trace]
    assert times == sorted(times)
    assert first.trace[-1][2] == [0] * len(threads)


@given(st.lists(st.lists(durations, min_size=1, max_size=6), min_size=1, max_size=5))
def test_sleepers_wake_at_their_times_in_order_of_creation(threads):
    """Compared with a model without threads: each thread wakes at the sums of its sleeps, ties in order of creation."""
    trace = []
    with stepped() as clock:
        for number, sleeps in enumerate(threads):
            NodeProcess(str(number), clock).start(
                lambda number=number, sleeps=sleeps: [
                    (time.sleep(seconds + 0.01), trace.append((time.monotonic_ns(), number))) for seconds in sleeps
                ]
            )
        clock.run_for(100.0)
    expected = []
    for number, sleeps in enumerate(threads):
        now = 0
        for seconds in sleeps:
            now += int((seconds + 0.01) * 1e9)
            expected.append((now, number))
    assert trace == sorted(expected)
