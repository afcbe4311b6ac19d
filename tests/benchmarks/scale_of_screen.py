"""How the cost of the screen grows: `python tests/benchmarks/scale_of_screen.py [CURVE ...]`, JSON out.

CPU time, the minimum of several runs. `stock` curves are Textual's widgets with as many rows: the cost of a
straightforward screen. Robots are simulators side by side in one process.
"""

from __future__ import annotations

import asyncio
import json
import sys
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from types import MappingProxyType
from typing import Any

from bot_console.runtime.importer import install

install()
sys.path[:0] = [str(Path(__file__).parents[1] / "helpers"), str(Path(__file__).parent)]

import numpy as np
from bench_logs import filled_store
from bench_simulation import WORLDS
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.model import (
    Endpoint,
    GraphInfo,
    Kind,
    LogFilter,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
    Severity,
)
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.view import Axes, framed_plot
from bot_console.tui.panes.topics.rows import Kind as Listed
from bot_console.tui.panes.topics.rows import rows
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world_file import load_world
from fakes.console import FakeConsole
from textual.app import App, ComposeResult
from textual.widgets import DataTable, RichLog

RUNS = 3
MILLI = 1e3
EACH = 25
"""Parameters of a node."""
SAMPLES = 10_000
"""Samples of each plotted curve."""
Measure = Callable[[int], float]


def least(action: Callable[[], Any]) -> float:
    """Milliseconds of CPU time of an action, the minimum of several runs."""
    found: list[float] = []
    for _ in range(RUNS):
        start = time.process_time()
        action()
        found.append(time.process_time() - start)
    return min(found) * MILLI


async def draw_cost(app: App[None], work: Callable[[], object]) -> float:
    """Milliseconds of CPU time from a change until the screen of 120x40 shows it."""
    async with app.run_test(size=(120, 40)) as pilot:
        await pilot.pause()
        start = time.process_time()
        work()
        await pilot.pause()
        return (time.process_time() - start) * MILLI


def once_or_more(measured: Callable[[], Awaitable[float]]) -> float:
    """The minimum of several runs of a screen."""

    async def run() -> float:
        return await measured()

    return min(asyncio.run(run()) for _ in range(RUNS))


def parameter_tree(count: int) -> float:
    """Milliseconds until the parameter pane shows `count` parameters that arrived at once."""
    trees: dict[str, ParameterTree] = {}
    for number in range(count // EACH):
        node = f"/robot{number // 20}/n{number}"
        infos = (ParameterInfo(node, f"group{at // 5}.gain{at}", Kind.DOUBLE, 1.0, default=1.0) for at in range(EACH))
        trees[node] = ParameterTree(node, tuple(infos))
    console = FakeConsole()

    async def measured() -> float:
        app = BotConsoleApp(console, refresh_hz=0, opening=Opening("parameters"))

        def show() -> None:
            console.change(parameters=MappingProxyType(trees))
            app.pull()

        console.change(parameters=MappingProxyType({}))
        return await draw_cost(app, show)

    return once_or_more(measured)


class StockTable(App[None]):
    """A Textual table."""

    def compose(self) -> ComposeResult:
        """One table."""
        yield DataTable[str]()

    def fill(self, count: int) -> None:
        """Add rows in the straightforward way."""
        table = self.query_one(DataTable)
        table.add_columns("parameter", "value")
        for number in range(count):
            table.add_row(f"group{number}.gain", "1.0")


class StockLog(App[None]):
    """A Textual log."""

    def compose(self) -> ComposeResult:
        """One log."""
        yield RichLog()

    def fill(self, count: int) -> None:
        """Write lines."""
        log = self.query_one(RichLog)
        for number in range(count):
            log.write(f"[INFO] [robot_navigator]: scan of {number % 997 / 100:.2f} m, cycle {number}")


def stock_table(count: int) -> float:
    """Milliseconds until a stock table shows `count` rows."""

    async def measured() -> float:
        app = StockTable()
        return await draw_cost(app, lambda: app.fill(count))

    return once_or_more(measured)


def stock_log(count: int) -> float:
    """Milliseconds to write lines to a stock log, which has no filter, so that all matching lines are written again."""

    async def measured() -> float:
        app = StockLog()
        return await draw_cost(app, lambda: app.fill(count))

    return once_or_more(measured)


def severity_filter(count: int) -> float:
    """Milliseconds to find the errors among `count` records."""
    store = filled_store(count)
    return least(lambda: matching(store, LogFilter(minimum=Severity.ERROR)))


def rare_word(count: int) -> float:
    """Milliseconds to find a rare word among `count` records."""
    store = filled_store(count)
    return least(lambda: matching(store, LogFilter(words="zebra")))


def plotted(count: int) -> float:
    """Milliseconds to draw `count` curves, of 10,000 samples each, into 120x40 cells."""
    times = np.linspace(0.0, 100.0, SAMPLES)
    curves = [Curve(f"/topic{at}/data", at, times, np.sin(times * (1 + at / 7))) for at in range(count)]
    return least(lambda: framed_plot(curves, (), Axes(0.0, 100.0), 120, 40))


def topic_rows(count: int) -> float:
    """Milliseconds to rebuild the rows of `count` topics after a change."""
    nodes = tuple(
        NodeInfo(
            f"/node{at}",
            publishers=tuple(Endpoint(f"/topic{at * 10 + each}", ("std_msgs/msg/Float64",)) for each in range(10)),
            subscriptions=tuple(Endpoint(f"/topic{each}", ("std_msgs/msg/Float64",)) for each in range(10)),
        )
        for at in range(count // 10)
    )
    graph = GraphInfo(nodes)
    return least(lambda: rows(graph, Listed.TOPICS, hidden=False))


def robots(count: int) -> float:
    """Milliseconds for a simulated second of `count` robots, each in its own world, with scans at 10 Hz."""
    driven = [Simulation(load_world(WORLDS / "indoor.yaml"), seed) for seed in range(count)]

    def second() -> None:
        for step in range(100):
            for each in driven:
                each.command(0.3, 0.4)
                each.step()
                if step % 10 == 0:
                    each.scan()

    return least(second)


CURVES: dict[str, tuple[Measure, tuple[int, ...]]] = {
    "parameter_tree_ms": (parameter_tree, (100, 1_000, 5_000)),
    "parameter_tree_ms stock": (stock_table, (100, 1_000, 5_000)),
    "log_severity_ms": (severity_filter, (10_000, 100_000, 1_000_000)),
    "log_word_ms": (rare_word, (10_000, 100_000, 1_000_000)),
    "log_word_ms stock": (stock_log, (1_000, 10_000)),
    "plot_ms": (plotted, (1, 4, 16, 64)),
    "topic_rows_ms": (topic_rows, (30, 100, 300, 1_000)),
    "robots_ms": (robots, (1, 3, 10, 30)),
}


def main(wanted: list[str]) -> None:
    """Measure the named curves, or all of them."""
    table: dict[str, dict[str, float]] = {}
    for name in wanted or CURVES:
        measure, sizes = CURVES[name]
        table[name] = {str(size): round(measure(size), 3) for size in sizes}
    print(json.dumps(table, indent=1))


if __name__ == "__main__":
    main(sys.argv[1:])
