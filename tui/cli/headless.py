"""`bot-console --headless`: the same system without a screen, in real time or as fast as it goes.

Logs are on stderr as ROS prints them; stdout gets one JSON object at the end.
"""

from __future__ import annotations

import contextlib
import json
import sys
import time
from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bot_console.runtime.importer import install
from bot_console.runtime.process import MAIN, NodeProcess, on_notice, stepped
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.workspaces import choose

if TYPE_CHECKING:
    from bot_console.tui.cli.headless_launches import Launches

DURATION = 60.0
"""Seconds of a run for which no duration is given."""
GRACE = 5.0
"""Seconds that the last question, and the end of the launched processes, may take."""


def run(options: Options) -> int:
    """Run the system for a while and print the report; 1 when there is nothing to report."""
    if options.launch and not Path(options.launch).is_file():
        print(f"there is no launch file {options.launch}", file=sys.stderr)
        return 1
    install()
    choose(options.workspace)
    duration = DURATION if options.duration is None else options.duration
    began = time.perf_counter()
    with _time(options) as clock, _notices():
        from bot_console.tui.cli.headless_launches import Launches
        from bot_console.tui.cli.observer import Observer

        observer = Observer(duration)
        watching = NodeProcess("observer", clock)
        watching.start(observer.run, argv=["observer"])
        launches = Launches(options, clock)
        launches.begin()
        with contextlib.suppress(KeyboardInterrupt):
            _wait_for(observer, launches, clock.steady_ns() + round((duration + GRACE) * 1e9))
        report = observer.report()
        launches.stop(GRACE)
        watching.stop(GRACE)
        report["deterministic"] = bool(getattr(clock, "deterministic", False))
        stalls = getattr(clock, "stalls", [])
    report["wall_time"] = round(time.perf_counter() - began, 3)
    if stalls:
        report["stalls"] = stalls
    print(json.dumps(report, indent=2))
    return 0 if observer.complete else _no_report(launches)


def _no_report(launches: Launches) -> int:
    code = launches.exit_code
    ended = f"; the launch had ended with exit code {code}" if code is not None else ""
    unwanted = "" if launches.has_robot else "; no simulator was started beside it, --simulator starts one"
    print(
        f"no simulator has answered the question for its report{ended}{unwanted}; the log above says more",
        file=sys.stderr,
    )
    return 1


@contextlib.contextmanager
def _time(options: Options) -> Generator[Any]:
    """The clock of the run."""
    if not options.fast:
        yield MAIN.clock
        return
    with stepped(seed=options.seed or 0, virtual_main=True) as clock:
        yield clock


@contextlib.contextmanager
def _notices() -> Generator[None]:
    forget = on_notice(lambda process, text: print(f"[WARN] [{process.name}]: {text}", file=sys.stderr))
    try:
        yield
    finally:
        forget()


def _wait_for(observer: Any, launches: Launches, deadline_ns: int) -> None:
    """Until the report is there, all launches have ended, or it is too late."""
    launches.on_end(observer.done.set)
    observer.done.wait(max(0.0, (deadline_ns - MAIN.clock.steady_ns()) * 1e-9))
