"""The cost of turns, waits and node processes: `python tests/benchmarks/bench_stepping.py [RUNS]`, JSON out.

CPU time in microseconds unless a name says otherwise, medians of several runs with spread. The floor of a turn: two
threads that wake each other with one lock each, on one processor like the stepped run.
"""

from __future__ import annotations

import json
import statistics
import sys
import threading
import time
from _thread import allocate_lock
from collections.abc import Callable

from bot_console.runtime.process import NodeProcess, RealTime, current, stepped, unpatched
from bot_console.runtime.process.node.thread_state import local
from bot_console.runtime.process.stepping.one_cpu import pin_thread

TURNS = 20_000
Measure = Callable[[], float]


def cpu() -> float:
    return time.process_time()


def floor_of_a_turn() -> float:
    """Two plain threads and two plain locks."""
    unpin = pin_thread()
    locks = allocate_lock(), allocate_lock()
    for lock in locks:
        lock.acquire()

    def player(mine: int) -> None:
        for _ in range(TURNS // 2):
            locks[mine].acquire()
            locks[1 - mine].release()

    threads = [threading.Thread(target=player, args=(mine,)) for mine in (0, 1)]
    for thread in threads:
        unpatched.start_thread(thread)
    start = cpu()
    locks[0].release()
    for thread in threads:
        unpatched.join_thread(thread)
    unpin()
    return (cpu() - start) / TURNS * 1e6


def turn_by_wakeups() -> float:
    """Two processes of a stepped run that wake each other."""
    with stepped() as clock:
        addresses = clock.wakeup(), clock.wakeup()

        def player(mine: int) -> Callable[[], None]:
            def run() -> None:
                for _ in range(TURNS // 2):
                    addresses[mine].wait()
                    addresses[mine].clear()
                    addresses[1 - mine].set()

            return run

        processes = [NodeProcess(str(mine), clock) for mine in (0, 1)]
        for process, mine in zip(processes, (0, 1), strict=True):
            process.start(player(mine))
        start = cpu()
        addresses[0].set()
        processes[1].wait()
        return (cpu() - start) / TURNS * 1e6


def turn_by_timers(count: int) -> float:
    """Processes that repeatedly sleep 10 ms."""
    with stepped() as clock:

        def run() -> None:
            while True:
                time.sleep(0.01)

        for number in range(count):
            NodeProcess(str(number), clock).start(run)
        start = cpu()
        clock.run_for(0.01 * TURNS / count)
        return (cpu() - start) / TURNS * 1e6


def wait_that_need_not_hand_on() -> float:
    """A sleep of the only thread: time jumps, and no other thread runs."""
    with stepped() as clock:
        start = cpu()
        for _ in range(TURNS):
            clock.sleep_until(clock.steady_ns() + 1000)
        return (cpu() - start) / TURNS * 1e6


def turn_in_real_time() -> float:
    """Two processes in real time that wake each other."""
    addresses = RealTime().wakeup(), RealTime().wakeup()

    def player(mine: int) -> Callable[[], None]:
        def run() -> None:
            for _ in range(TURNS // 2):
                addresses[mine].wait()
                addresses[mine].clear()
                addresses[1 - mine].set()

        return run

    processes = [NodeProcess(str(mine)) for mine in (0, 1)]
    for process, mine in zip(processes, (0, 1), strict=True):
        process.start(player(mine))
    start = cpu()
    addresses[0].set()
    processes[1].wait()
    return (cpu() - start) / TURNS * 1e6


def sleep_outside(wrapped: bool) -> float:
    """`time.sleep(0)` in the real process, with and without the wrapper."""
    sleep = time.sleep if wrapped else unpatched.sleep
    assert local.waits_on is None
    start = cpu()
    for _ in range(TURNS):
        sleep(0)
    return (cpu() - start) / TURNS * 1e6


def current_process() -> float:
    """`current()`."""
    start = cpu()
    for _ in range(TURNS):
        current()
    return (cpu() - start) / TURNS * 1e6


def start_and_end() -> float:
    """A process that does nothing, from start to exit code."""
    count = 200
    start = cpu()
    for number in range(count):
        process = NodeProcess(str(number))
        process.start(lambda: None, env={}, stdout=len)
        process.wait()
    return (cpu() - start) / count * 1e6


def interrupt_sleeping() -> float:
    """200 sleeping processes, interrupted and waited for, per process."""
    count = 200
    processes = [NodeProcess(str(number)) for number in range(count)]
    for process in processes:
        process.start(lambda: time.sleep(1000), env={}, stderr=len)
    start = cpu()
    for process in processes:
        process.interrupt()
    for process in processes:
        process.wait()
    return (cpu() - start) / count * 1e6


MEASURES: dict[str, Measure] = {
    "floor: turn of two plain threads": floor_of_a_turn,
    "turn by wakeups, stepped": turn_by_wakeups,
    "turn by timers, 10 processes, stepped": lambda: turn_by_timers(10),
    "turn by timers, 100 processes, stepped": lambda: turn_by_timers(100),
    "sleep of a lone thread, stepped": wait_that_need_not_hand_on,
    "turn by wakeups, real time": turn_in_real_time,
    "time.sleep(0) outside, not wrapped": lambda: sleep_outside(False),
    "time.sleep(0) outside, wrapped": lambda: sleep_outside(True),
    "current()": current_process,
    "start and end of a process": start_and_end,
    "interrupt of a sleeping process": interrupt_sleeping,
}


def main(runs: int) -> None:
    """Measure everything in turn, several times, and print it."""
    samples: dict[str, list[float]] = {name: [] for name in MEASURES}
    for _ in range(runs):
        for name, measure in MEASURES.items():
            samples[name].append(measure())
    floor = statistics.median(samples["floor: turn of two plain threads"])
    result = {
        name: {
            "median_us": round(statistics.median(values), 3),
            "min_us": round(min(values), 3),
            "max_us": round(max(values), 3),
            "times_floor": round(statistics.median(values) / floor, 2),
        }
        for name, values in samples.items()
    }
    print(json.dumps({"runs": runs, "python": sys.version.split()[0], "cpu": result}, indent=1))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
