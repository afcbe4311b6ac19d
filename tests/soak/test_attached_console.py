"""Half an hour of everything that a console does beside a robot, on any rclpy: nothing is lost, nothing grows.

`-m soak` runs it on the embedded runtime, `BOT_CONSOLE_TESTS_ON=ros pytest -m ros tests/soak` on a sourced ROS 2.
BOT_CONSOLE_SOAK_MINUTES sets its length; the default is 30. The measurements are printed (`-s`).
"""

from __future__ import annotations

import contextlib
import gc
import itertools
import os
import resource
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
import rclpy
from bot_console.tui.console.model import LogFilter, Severity
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rigs import ROBOT, TIMEOUT_S, RosRig, is_embedded_rclpy, machine_rig, until

MINUTES = float(os.environ.get("BOT_CONSOLE_SOAK_MINUTES", "30"))
WAYS = [
    pytest.param(RosRig, id="embedded", marks=pytest.mark.soak),
    pytest.param(machine_rig, id="ros", marks=pytest.mark.ros),
]
PERIOD = 0.05
"""Seconds between two rounds."""
SHORT, LONG = 20, 200
"""Rounds between two changes of the view, and between two visits of another node."""
SLOWEST = 5.0
"""Seconds that the slowest of all sets may take on a machine that does other work as well."""
GROWTH = 10e6
"""Bytes by which the process may grow from the first third to the end, plus a kilobyte for each line of the log."""


@dataclass
class Measurements:
    """The measurements."""

    rounds: int = 0
    lines: int = 0
    slowest: float = 0.0
    sizes: list[int] = field(default_factory=list)
    """Resident memory (bytes) every minute, or ten times in a shorter run."""
    threads: list[int] = field(default_factory=list)
    ends: list[int] = field(default_factory=list)
    """The number of the console's endpoints, at the same times."""


def resident_bytes() -> int:
    """This process's memory in bytes."""
    gc.collect()
    with contextlib.suppress(OSError):
        return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()
    return 0


@contextlib.contextmanager
def visitor(domain: int, name: str) -> Iterator[None]:
    """Add another node of the robot for a while."""
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain)
    node = rclpy.create_node(name, context=context)
    node.declare_parameter("stay", 1.0)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def spin() -> None:
        with contextlib.suppress(ExternalShutdownException):
            executor.spin()

    thread = threading.Thread(target=spin, daemon=True)
    thread.start()
    try:
        yield
    finally:
        executor.shutdown(timeout_sec=1.0)
        node.destroy_node()
        context.try_shutdown()
        thread.join(TIMEOUT_S)


def a_round(rig: RosRig, number: int, seen: Measurements) -> None:
    """Set a value, be refused, publish, log and drive; sometimes change the view, stop, and add a visiting node."""
    console = rig.console
    began = time.monotonic()
    taken = console.parameters.set(ROBOT, {"speed": 0.5 + number % 10 / 10}).result(TIMEOUT_S)
    refused = console.parameters.set(ROBOT, {"speed": 9.0}).result(TIMEOUT_S)
    seen.slowest = max(seen.slowest, time.monotonic() - began)
    assert [each.accepted for each in (*taken, *refused)] == [True, False]
    for each in range(10):
        rig.publish(float(each))
    if number % 2 == 0:
        rig.show_text(Severity.WARN, f"line {seen.lines}")
        seen.lines += 1
    console.drive.move(0.1, 0.0)
    if number % SHORT == 0:
        watched = number // SHORT % 2 == 0
        console.topics.listen("/level" if watched else "")
        assert console.plots.watch("/level/data").ok
        if not watched:
            console.plots.unwatch("/level/data")
        console.drive.stop(watched)
    if number % LONG == 0:
        name = f"/visitor_{number}"
        with visitor(rig.domain, name[1:]):
            until(lambda: name in console.snapshot().parameters, "the visitor's parameters")
        until(lambda: name not in console.snapshot().parameters, "that the visitor has gone")


def ends_of_console(rig: RosRig) -> int:
    """The endpoints of hidden nodes, which are the console's."""
    hidden = [each for each in rig.console.snapshot().graph.nodes if each.hidden]
    return sum(len(ends) for each in hidden for ends in (each.publishers, each.subscriptions, each.clients))


@pytest.mark.timeout(MINUTES * 60 + 300)
@pytest.mark.parametrize("make", WAYS)
def test_nothing_is_lost_and_nothing_grows(make, tmp_path: Path) -> None:
    assert make is machine_rig or is_embedded_rclpy()
    rig, seen = make(tmp_path), Measurements()
    began, step = time.monotonic(), min(60.0, MINUTES * 60 / 10)
    try:
        for number in itertools.count():
            a_round(rig, number, seen)
            seen.rounds += 1
            now = time.monotonic() - began
            if now >= step * (len(seen.sizes) + 1):
                seen.sizes.append(resident_bytes())
                seen.threads.append(threading.active_count())
                seen.ends.append(ends_of_console(rig))
            if now >= MINUTES * 60:
                break
            threading.Event().wait(PERIOD)
        which = LogFilter(words="node:robot sev:warn")
        until(lambda: len(rig.console.logs.matching(which, 0)) >= seen.lines, "the last line of the log")
        print(f"\n{seen}, processor time {time.process_time():.0f} s")
        assert not rig.console.snapshot().problem
        assert len(rig.console.logs.matching(which, 0)) == seen.lines
        assert seen.slowest < SLOWEST
        third = max(1, len(seen.sizes) // 3)
        for counts in (seen.threads, seen.ends):  # They go up and down with the view.
            assert min(counts[-third:]) <= max(counts[:third])
        assert seen.sizes[-1] - seen.sizes[third] < GROWTH + 1000 * seen.lines
    finally:
        rig.close()
