"""The cost of the log: `python tests/benchmarks/bench_logs.py [RECORDS]`, JSON out.

CPU time in ms for RECORDS records (default 1,000,000), medians with spread. The ratio is to one numpy pass over as many
bytes as the texts have, so that machines can be compared. `goal` is for a million records.
"""

from __future__ import annotations

import json
import statistics
import sys
import threading
import time
from collections.abc import Callable

import numpy as np
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import CAPACITY, LogStore
from bot_console.tui.console.logs.view import LogViews
from bot_console.tui.console.model import LogFilter, Severity

RUNS = 5
GOALS = {"severity": 3, "rare word": 40, "rare regex": 100}
MANY = 600
"""The goal (ms) for filters with many matches."""
FILTERS = {
    "severity": LogFilter(minimum=Severity.ERROR),
    "rare word": LogFilter(words="zebra"),
    "rare regex": LogFilter(words=r"re:z\w+a.*E\d+"),
    "common word": LogFilter(words="scan"),
    "word in half": LogFilter(words=r"re:[02468]$"),
    "all": LogFilter(words="cycle"),
    "class over lines": LogFilter(words=r"re:\s\d"),
    "negated class": LogFilter(words=r"re:[^a-z]\W"),
    "hostile regex": LogFilter(words=r"re:(.|\w)*%%"),
    "node and word": LogFilter(words="node:safety scan"),
    "place": LogFilter(words="at:nav.py:12"),
    "time of day": LogFilter(words="time:00:00..00:30"),
    "four rules hide": LogFilter(hidden=("node:=telemetry", "sev:debug", "at:nav.py:12", "zebra")),
    "folded": LogFilter(folded=True),
}


def filled_store(records: int) -> LogStore:
    store = LogStore(max(CAPACITY, records))
    kinds = ("scan of", "speed is", "obstacle at", "target at", "odometry says")
    nodes = ("robot_navigator", "safety_monitor", "telemetry", "sensors")
    for number in range(records):
        text = f"{kinds[number * 7 % 5]} {number % 997 / 100:.2f} m, cycle {number}"
        site = ("nav.py", "spin", number % 20)
        rare = number % (records // 4) == 7
        store.add(number, 40 if rare else 20, nodes[number % 4], "a zebra, error E42" if rare else text, site)
    return store


def cpu(action: Callable[[], object]) -> list[float]:
    times: list[float] = []
    for _ in range(RUNS):
        start = time.process_time()
        action()
        times.append((time.process_time() - start) * 1000)
    return times


def summary(times: list[float], unit: float) -> dict[str, float]:
    median = statistics.median(times)
    return {"ms": round(median, 2), "from": round(min(times), 2), "to": round(max(times), 2),
            "ratio": round(median / unit, 2)}  # fmt: skip


def first_screenful(store: LogStore, which: LogFilter) -> list[float]:
    """Wall time (ms) from the query to the newest 50 matches."""
    times: list[float] = []
    for _ in range(RUNS):
        views = LogViews(store)
        start = time.perf_counter()
        view = views.open(which)
        while len(view.poll().numbers) < 50:
            time.sleep(0.0002)
        times.append((time.perf_counter() - start) * 1000)
        views.close()
    return times


def slowest_add(store: LogStore) -> float:
    """The longest time (ms) for adding a record during a search that matches half of them."""
    done, slowest = threading.Event(), [0.0]

    def add() -> None:
        while not done.is_set():
            start = time.perf_counter()
            store.add(1, 20, "robot", "a line that comes meanwhile")
            slowest[0] = max(slowest[0], (time.perf_counter() - start) * 1000)
            time.sleep(0.001)

    thread = threading.Thread(target=add)
    thread.start()
    matching(store, FILTERS["word in half"])
    done.set()
    thread.join()
    return round(slowest[0], 2)


def main() -> None:
    records = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    started = time.process_time()
    store = filled_store(records)
    adding = (time.process_time() - started) / records * 1e6
    text = sum(int(each.start[each.count]) for each in store.segments)
    columns = ("stamp", "severity", "node", "site", "start", "key")
    held = sum(getattr(each, name).nbytes for each in store.segments for name in columns) + text
    data = np.zeros(text, np.uint8)
    unit = statistics.median(cpu(lambda: np.count_nonzero(data == 10)))
    report = {
        "records": records,
        "bytes per record": round(held / records, 1),
        "add (us)": round(adding, 2),
        "unit (ms)": round(unit, 2),
        "search": {name: summary(cpu(lambda which=which: matching(store, which)), unit)
                   | {"goal": GOALS.get(name, MANY)} for name, which in FILTERS.items()},
        "first screenful": {name: summary(first_screenful(store, FILTERS[name]), unit) | {"goal": 20}
                            for name in ("common word", "word in half", "all", "folded")},
        "slowest add during a search (ms)": slowest_add(store),
    }  # fmt: skip
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
