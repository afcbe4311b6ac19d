"""The screen's cost of thousands of parameters: `python tests/benchmarks/bench_tree.py [RUNS]`, JSON out.

CPU time in ms, medians of several runs with the maximum: the whole tree of 5,000 parameters of 200 nodes at once, a key
in the filter, and one changed value, with the number of rows drawn for it. The app runs without a terminal. `idle_ms`
is the cost of waiting for the screen when nothing has changed; the others include it.
"""

from __future__ import annotations

import asyncio
import gc
import json
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from bot_console.runtime.importer import install

install()
sys.path[:0] = [str(Path(__file__).parents[1] / "helpers")]

from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Range
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from fakes.console import FakeConsole

NODES, EACH = 200, 25
WORDS = "n1 speed"


def trees() -> dict[str, ParameterTree]:
    """Nodes in ten namespaces, with groups of parameters."""
    found: dict[str, ParameterTree] = {}
    for number in range(NODES):
        node = f"/robot{number // 20}/n{number}"
        names = [f"group{at // 5}.{('speed', 'gain', 'limit', 'rate', 'offset')[at % 5]}" for at in range(EACH)]
        found[node] = ParameterTree(
            node,
            tuple(
                ParameterInfo(node, each, Kind.DOUBLE, 1.0, f"What {each} is (m/s)", range=Range(0.0, 5.0), default=1.0)
                for each in names
            ),
        )
    return found


class CountingRows(ParameterRows):
    """Counts the rows that are drawn."""

    drawn = 0

    def row(self, index: int, width: int) -> Any:
        """Count a row."""
        CountingRows.drawn += 1
        return super().row(index, width)


async def measure() -> dict[str, float]:
    """One run."""
    console = FakeConsole()
    app = BotConsoleApp(console, refresh_hz=0, opening=Opening("parameters"))
    found: dict[str, float] = {}
    async with app.run_test(size=(120, 40)) as pilot:
        await pilot.pause()
        pane = app.query_one(ParametersPane)
        pane.query_one(ParameterRows).__class__ = CountingRows
        every = trees()

        async def timed(work: Callable[[], object]) -> float:
            begin = time.process_time()
            work()
            await pilot.pause()
            return (time.process_time() - begin) * 1e3

        def show(now: dict[str, ParameterTree]) -> None:
            console.change(parameters=MappingProxyType(now))
            app.pull()

        found["idle_ms"] = statistics.median([await timed(lambda: None) for _ in range(5)])
        found["full_tree_ms"] = await timed(lambda: show(every))
        keys = [await timed(lambda end=end: pane.set_filter(WORDS[:end])) for end in range(1, len(WORDS) + 1)]
        found["filter_key_ms"] = statistics.median(keys)
        found["filter_key_worst_ms"] = max(keys)
        await timed(lambda: pane.set_filter(""))
        node = next(iter(every))
        first, *rest = every[node].parameters
        tree = replace(every[node], parameters=(replace(first, value=2.0), *rest))
        CountingRows.drawn = 0
        found["one_change_ms"] = await timed(lambda: show({**every, node: tree}))
        found["rows_drawn_for_it"] = CountingRows.drawn
    return found


def main(runs: int) -> None:
    """Print the medians."""
    gc.freeze()  # The program does the same.
    rows = [asyncio.run(measure()) for _ in range(runs)]
    found = {
        name: {
            "median": round(statistics.median(row[name] for row in rows), 2),
            "worst": round(max(row[name] for row in rows), 2),
        }
        for name in rows[0]
    }
    print(json.dumps({"parameters": NODES * EACH, "nodes": NODES, **found}, indent=2))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 3)
