"""Many processes in one domain, from a few that start at one moment to a graph of thousands of entities; JSON.

    python tests/soak/many_processes.py --meet 10          rounds of 50 that start together: how many pairs talk
    python tests/soak/many_processes.py --graph            20 with 10 nodes of 25 entities each, all query the graph

`cpu_s` is the CPU time per process, `most` that of the busiest one, from the query until everything is known; `rest` is
the CPU share of all of them afterwards, and `grown_mb` the memory by which the largest grows meanwhile. Linux.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import tempfile
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bot_console.runtime.children.warm_up import warm_up

PROCESSES = 50
TIMEOUT_S = 120.0
"""Seconds until a process reports what it has found so far."""
PERIOD = 0.25
HOLDERS, NODES, ENTITIES = 20, 10, 25
REST = 10.0
Work = Callable[[int, Callable[[], None]], Any]
"""The work of a process, called with its number and a function that waits for the others; returns its report."""


def run_together(count: int, work: Work, steps: int) -> list[Any]:
    """Fork processes that take each step at the same moment; return their reports."""
    addresses = [os.pipe() for _ in range(steps)]
    arrivals, reports, children = os.pipe(), [os.pipe() for _ in range(count)], []
    for number in range(count):
        pid = os.fork()
        if pid == 0:
            passed = iter(addresses)

            def wait(passed: Any = passed) -> None:
                os.write(arrivals[1], b".")
                os.read(next(passed)[0], 1)

            try:
                for _, end in addresses:
                    os.close(end)
                os.write(reports[number][1], json.dumps(work(number, wait)).encode())
                signal.pause()
            except BaseException:
                traceback.print_exc()
            finally:  # Whatever ends it: otherwise it would continue as its parent, and fork as many again.
                os._exit(1)
        children.append(pid)
    for _, end in addresses:
        for _ in range(count):
            os.read(arrivals[0], 1)
        os.close(end)
    reported = [json.loads(os.read(report[0], 1 << 16)) for report in reports]
    for pid in children:
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
    for end in (*arrivals, *(each[0] for each in addresses), *(each for pair in reports for each in pair)):
        os.close(end)
    return reported


def joined_node(name: str) -> Any:
    """A node in the common domain."""
    import rclpy
    from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains

    share_domains()
    rclpy.init(args=[])
    return rclpy.create_node(name)


def until(done: Callable[[], bool], each: Callable[[], object] = lambda: None) -> bool:
    """Whether a condition came true in time; `each` is called before each check."""
    deadline = time.monotonic() + TIMEOUT_S
    while not done():
        if time.monotonic() > deadline:
            return False
        each()
        time.sleep(PERIOD)
    return True


def meet(number: int, wait: Callable[[], None]) -> int:
    """Count how many others one process has heard; it keeps talking until all have reported."""
    import threading

    import rclpy
    from std_msgs.msg import Int32

    wait()
    node = joined_node(f"guest_{number}")
    heard = set[int]()
    node.create_subscription(Int32, "/here", lambda message: heard.add(message.data), PROCESSES)
    publisher = node.create_publisher(Int32, "/here", PROCESSES)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    node.create_timer(PERIOD, lambda: publisher.publish(Int32(data=number)))
    until(lambda: len(heard) == PROCESSES)
    return len(heard - {number})


def hold(number: int, wait: Callable[[], None]) -> dict[str, Any]:
    """Create nodes with entities, then discover all others; returns the cost."""
    import rclpy
    from std_msgs.msg import Int32

    first = joined_node(f"holder_{number}")
    nodes = [first, *(rclpy.create_node(f"holder_{number}_{each}") for each in range(1, NODES))]
    (own,) = first.context.bus._local.tables()  # Not by a graph query, since none may have been made yet.
    few = entities([own]) // NODES
    for node in nodes:
        for each in range(ENTITIES - few):
            node.create_publisher(Int32, f"{node.get_name()}/topic_{each}", 1)
    wait()
    began, spent = time.monotonic(), time.process_time()
    bus = first.context.bus
    whole = HOLDERS * NODES * ENTITIES
    complete = until(lambda: entities(bus.tables()) >= whole)
    took, cost, known = time.monotonic() - began, time.process_time() - spent, entities(bus.tables())
    wait()
    memory, spent, began = own_mb(), time.process_time(), time.monotonic()
    time.sleep(REST)
    rest = (time.process_time() - spent) / (time.monotonic() - began)
    grown = own_mb() - memory
    return {"complete": complete, "entities": known, "took": took, "cost": cost, "rest": rest, "grown": grown}


def entities(tables: Any) -> int:
    """The number of publishers, subscriptions, servers and clients."""
    kinds = ("publishers", "subscriptions", "servers", "clients")
    return sum(len(getattr(each, kind).all()) for each in tables for kind in kinds)


def own_mb() -> float:
    """Memory (MB) of this process that it shares with no other."""
    _, resident, shared, *_ = Path("/proc/self/statm").read_text().split()
    return (int(resident) - int(shared)) * os.sysconf("SC_PAGE_SIZE") / 1e6


def graph() -> dict[str, Any]:
    """One system of many nodes."""
    reported = run_together(HOLDERS, hold, 2)
    return {
        "entities": [min(each["entities"] for each in reported), HOLDERS * NODES * ENTITIES],
        "complete": all(each["complete"] for each in reported),
        "took_s": round(max(each["took"] for each in reported), 2),
        "cpu_s": {
            "most": round(max(each["cost"] for each in reported), 2),
            "all": round(sum(each["cost"] for each in reported), 2),
        },
        "rest": round(sum(each["rest"] for each in reported), 3),
        "grown_mb": round(max(each["grown"] for each in reported), 2),
    }


def main() -> None:
    """Run what the command line requests."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--meet", type=int, default=0, metavar="ROUNDS")
    parser.add_argument("--graph", action="store_true")
    given = parser.parse_args()
    warm_up()
    for _ in range(given.meet):
        with tempfile.TemporaryDirectory(prefix="bc-", dir="/tmp") as folder:
            os.environ["BOT_CONSOLE_SOCKET_DIR"] = f"{folder}/s"
            reported = run_together(PROCESSES, meet, 1)
        print(json.dumps({"pairs": [sum(reported), PROCESSES * (PROCESSES - 1)]}), flush=True)
    if given.graph:
        with tempfile.TemporaryDirectory(prefix="bc-", dir="/tmp") as folder:
            os.environ["BOT_CONSOLE_SOCKET_DIR"] = f"{folder}/s"
            print(json.dumps(graph()), flush=True)


if __name__ == "__main__":
    main()
