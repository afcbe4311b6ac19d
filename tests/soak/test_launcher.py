"""The launcher over hundreds of restarts leaves no thread, file descriptor or object behind. Run with `-m soak`."""

from __future__ import annotations

import gc
import itertools
import os
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.model import ProcessState
from domains import unused_domain
from launcher_bench import ENDS, WAITS, Bench

pytestmark = [pytest.mark.soak, pytest.mark.timeout(600)]

WARM_UP = 20
"""Restarts before the first count: modules are imported and pools filled."""
RESTARTS = 500
SLACK = 50
"""Allowed growth in objects of one kind: a tenth of what one leaked object per restart would add."""
KEPT = {
    "launch.logging.launch_logger.LaunchLogger": "Python keeps loggers for ever, and each start has names of its own",
    "builtins.list": "handlers and filters of those",
    "bot_console.tui.console.model.LaunchEvent": "the timeline is not full yet",
}


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    """A launcher."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = Bench(tmp_path)
    yield made
    made.launcher.close()


def descriptors() -> list[str]:
    """The targets of this process's open file descriptors."""
    found: list[str] = []
    for each in Path("/proc/self/fd").iterdir():
        try:
            found.append(os.readlink(each))
        except FileNotFoundError:  # The descriptor used for listing.
            continue
    return sorted(found)


def census() -> Counter[str]:
    """Count the objects of each kind."""
    gc.collect()
    return Counter(f"{type(each).__module__}.{type(each).__qualname__}" for each in gc.get_objects())


def leaks_nothing(bench: Bench, once: Callable[[], None], end: Callable[[], object] = lambda: None) -> None:
    """Do something hundreds of times; check that what remains does not grow."""
    for _ in range(WARM_UP):
        once()
    threads, files, objects = threading.active_count(), len(descriptors()), census()
    for _ in range(RESTARTS):
        once()
    end()
    bench.until(lambda: threading.active_count() <= threads, f"{threading.enumerate()} to be {threads} threads")
    bench.until(lambda: len(descriptors()) <= files, f"{files} files of {descriptors()}")

    def left() -> dict[str, int]:
        return {kind: count for kind, count in (census() - objects).items() if count > SLACK and kind not in KEPT}

    # Some are released a few seconds later: those of unneeded escalations, and of the watch over busy nodes.
    bench.until(lambda: not left(), f"nothing to be left, but there is {left()}")


def test_restarts_of_a_node_leak_nothing(bench: Bench) -> None:
    program = bench.program(WAITS)
    assert bench.run(f"[Node(executable={program!r}, name='other'), Node(executable={program!r}, name='bob')]").ok
    key = bench.until(lambda: len(bench.info.processes) == 2 and bench.info.processes[1].key, "both")

    def once() -> None:
        assert bench.launcher.restart(key).result(30).ok
        bench.printed.clear()

    leaks_nothing(bench, once)
    other, steered = bench.info.processes
    assert steered.restarts == WARM_UP + RESTARTS and steered.state is ProcessState.RUNNING
    assert other.restarts == 0 and other.state is ProcessState.RUNNING


def test_restarts_of_a_killed_node_leak_nothing(bench: Bench) -> None:
    program = bench.program(WAITS)
    assert bench.run(f"[Node(executable={program!r}, name='bob')]").ok
    key = bench.process().key

    def once() -> None:
        assert bench.launcher.kill(key).result(30).ok
        assert bench.launcher.start(key).result(30).ok
        bench.printed.clear()

    leaks_nothing(bench, once)


def test_restarts_of_a_real_process_leak_nothing(bench: Bench) -> None:
    assert bench.run("[ExecuteProcess(cmd=['sleep', '1000'])]").ok
    key = bench.process().key
    leaks_nothing(bench, lambda: _restart(bench, key))


def _restart(bench: Bench, key: str) -> None:
    assert bench.launcher.restart(key).result(30).ok


def test_respawned_process_leaks_nothing(bench: Bench) -> None:
    program = bench.program(ENDS)
    assert bench.run(f"[Node(executable={program!r}, respawn=True, respawn_delay=0.001)]").ok
    until = itertools.count(1)

    def once() -> None:
        wanted = next(until)
        bench.until(lambda: bench.process().restarts >= wanted, f"respawn {wanted}")
        bench.printed.clear()

    leaks_nothing(bench, once, lambda: bench.do("stop", bench.process()))
