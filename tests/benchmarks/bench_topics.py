"""The cost of the topics pane: `python tests/benchmarks/bench_topics.py [RUNS]`, JSON out. Linux; a minute a run.

A process with 300 topics, 50 of them at 100 Hz, and a console in a pseudo-terminal of 120x40, which shows the topics
pane and then another pane: percent of a processor, bytes per second, and the differences.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from pty_meter import Terminal

CONSOLE = [sys.executable, "-m", "bot_console.tui"]
LOAD = str(Path(__file__).with_name("busy_topics.py"))
TOPICS, FAST = 300, 50
SIZE = (120, 40)
WARM, SPAN = 8.0, 10.0


def cost(pane: str, keys: str = "") -> dict[str, float]:
    """The cost of a console that shows a pane."""
    terminal = Terminal([*CONSOLE, "attach", "--pane", pane], SIZE)
    terminal.run(WARM)
    for key in keys:
        terminal.press(key)
        terminal.run(1.0)
    began, cpu, received = time.monotonic(), terminal.cpu(), terminal.received
    terminal.run(SPAN)
    span = time.monotonic() - began
    found = {"cpu %": 100 * (terminal.cpu() - cpu) / span, "bytes/s": (terminal.received - received) / span}
    sys.stderr.write(terminal.text() + "\n")
    terminal.close()
    return found


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    with tempfile.TemporaryDirectory(prefix="bc-", dir="/tmp") as folder:
        os.environ["BOT_CONSOLE_SOCKET_DIR"] = os.path.join(folder, "s")
        load = subprocess.Popen([*CONSOLE, "run", LOAD, str(TOPICS), str(FAST)], stdout=subprocess.DEVNULL)
        try:
            time.sleep(3)
            found = [(cost("topics"), cost("parameters")) for _ in range(runs)]
        finally:
            load.terminate()
            load.wait()
    middle = {
        name: {key: round(statistics.median(each[at][key] for each in found), 1) for key in found[0][at]}
        for at, name in enumerate(("topics", "another pane"))
    }
    more = {key: round(statistics.median(a[key] - b[key] for a, b in found), 1) for key in found[0][0]}
    print(json.dumps({**middle, "difference": more}, indent=2))


if __name__ == "__main__":
    main()
