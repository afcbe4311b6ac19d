"""`bot-console --headless`: the same system without a screen, in real time or as fast as possible.

Logs go to stderr in ROS's format; stdout gets one JSON object at the end.
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import json
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Generator
from typing import TYPE_CHECKING, Any, Protocol

from bot_console.runtime.importer import install
from bot_console.runtime.process import MAIN, NodeProcess, on_notice, stepped
from bot_console.runtime.stop_file_path import STOP_FILE_VARIABLE
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.interruptible_wait import wait_interruptibly
from bot_console.tui.cli.machine_limits import no_robot_here
from bot_console.tui.session.embedded.domain import (
    is_in_range,
    isolate_from_domain,
    report_of_other_start,
    robot_claim,
    running_robot_nodes,
    take_part,
    unusable_domain,
    why_no_robot,
)
from bot_console.tui.session.embedded.named_launch import with_launch_file
from bot_console.tui.session.embedded.workspaces import choose

if TYPE_CHECKING:
    from bot_console.tui.cli.headless.launches import Launches

Wait = Callable[[threading.Event, float], bool]
"""Waits for an event for at most a number of seconds; a stepped run does so on its own clock."""

DEFAULT_DURATION_S = 60.0
"""The default duration of a run."""
LAST_QUERY_TIMEOUT_S = 5.0
"""Seconds that the query for the final report may take."""
LAUNCH_END_TIMEOUT_S = 12.0
"""Seconds that the end of a launch may take: launch sends SIGTERM after 5 and SIGKILL after 10 seconds, and killing it
earlier would leave its processes behind.
"""
NODES_UP_AFTER_S = 0.1
"""Seconds after which the nodes count as up; garbage is collected from then on."""
START_TIMEOUT_S = 60.0
"""Seconds that a simulator may take to start and answer on a busy machine."""


def run(options: Options) -> int:
    """Run the system for a while and print the report; returns 1 without a report, or if a process has died."""
    options, problem = with_launch_file(options)
    if problem := unusable_domain() or no_robot_here() or problem:
        print(problem, file=sys.stderr)
        return 1
    gc.disable()  # Imported objects stay alive, and traversing them repeatedly would take a tenth of the start.
    install()
    choose(options.workspace)
    if not options.fast:
        _join_domain(options)
    report, observer, launches = run_simulation(options)
    print(json.dumps(report, indent=2))
    if not observer.complete:
        return _no_report(launches)
    if launches.died:
        print(
            f"{launches.died}, so the report may not be that of a whole run; the log above says more", file=sys.stderr
        )
    return 1 if launches.died else 0


class RunTask(Protocol):
    """A task that runs alongside the nodes of a run, in a node process of its own."""

    done: threading.Event
    """Set when the run may end."""
    complete: bool
    """Whether it has done everything that it had to do."""

    def run(self) -> None:
        """The main function of the node process."""
        ...

    def finish_early(self) -> None:
        """Finish early, since the nodes are about to end; may be called from any thread."""
        ...

    def report(self) -> dict[str, Any]:
        """The figures that are known at the end."""
        ...


def run_simulation(options: Options, observer: RunTask | None = None) -> tuple[dict[str, Any], RunTask, Launches]:
    """Run the system for a while; returns the observer's report, the observer, and the launches.

    `install` must have been called before.
    """
    duration = DEFAULT_DURATION_S if options.duration is None else options.duration
    began = time.perf_counter()
    with _interrupted_by_signals(), _run_clock(options) as clock, _notices():
        from bot_console.tui.cli.headless.launches import Launches
        from bot_console.tui.cli.headless.observer import Observer

        observer = observer or Observer(duration)
        watching = NodeProcess("observer", clock)
        watching.start(observer.run, argv=["observer"])
        launches = Launches(options, clock, observer.finish_early)
        launches.begin()
        with contextlib.suppress(KeyboardInterrupt):
            _wait_for(observer, launches, duration, threading.Event.wait if options.fast else wait_interruptibly)
        report = observer.report()
        launches.stop(LAUNCH_END_TIMEOUT_S)
        watching.stop(LAST_QUERY_TIMEOUT_S)
        report["deterministic"] = bool(getattr(clock, "deterministic", False))
        stalls = getattr(clock, "stalls", [])
    report["wall_time"] = round(time.perf_counter() - began, 3)
    if stalls:
        report["stalls"] = stalls
    return report, observer, launches


def _join_domain(options: Options) -> None:
    """Join the domain, unless another robot is in it, since both would obey each other's commands.

    A program that cannot join it still discovers the nodes that it launches.
    """
    problem = take_part()
    if problem:
        isolate_from_domain()
    elif not options.launch and is_in_range():
        claim = robot_claim()
        atexit.register(claim.release)
        if why := why_no_robot(
            claim.wait_for_robot(running_robot_nodes, report_of_other_start), options.launch_arguments
        ):
            claim.release()
            isolate_from_domain()
            problem = f"{why}; so this one runs in isolation"
    if problem:
        print(problem, file=sys.stderr)


def _no_report(launches: Launches) -> int:
    if launches.simulator_code is not None:
        ended = f"the simulator ended with exit code {launches.simulator_code} before it reported"
        print(f"{ended}; the log above says more", file=sys.stderr)
        return 1
    code = launches.exit_code
    ended = f"; the launch had ended with exit code {code}" if code is not None else ""
    unwanted = "" if launches.has_robot else "; no simulator was started beside it, --simulator starts one"
    print(
        f"no simulator has answered the request for a report{ended}{unwanted}; the log above says more",
        file=sys.stderr,
    )
    return 1


@contextlib.contextmanager
def _run_clock(options: Options) -> Generator[Any]:
    """The clock of the run."""
    if not options.fast:
        yield MAIN.clock
        return
    # Before the run, which seeds the random generators that exist by then. Besides, numpy's locks are then the
    # interpreter's own, so that no draw waits for a turn of the stepped run.
    from bot_console.runtime.process.stepping.one_cpu import import_numpy

    import_numpy()
    os.environ.pop(STOP_FILE_VARIABLE, None)  # the file belongs to the domain, which this run does not join
    from bot_console.runtime.rmw.lockstep.coordination import coordinated_run

    seed = options.seed or 0
    with stepped(seed=seed, virtual_main=True) as clock, coordinated_run(clock, seed):
        yield clock


@contextlib.contextmanager
def _notices() -> Generator[None]:
    forget = on_notice(lambda process, text: print(f"[WARN] [{process.name}]: {text}", file=sys.stderr))
    try:
        yield
    finally:
        forget()


def _wait_for(observer: RunTask, launches: Launches, duration: float, wait: Wait) -> None:
    """Wait for the report, the end of all launches, or the time limit; an interrupt requests the report at once."""
    launches.on_end(observer.done.set)
    try:
        wait(observer.done, NODES_UP_AFTER_S)
        if not gc.isenabled():
            gc.freeze()
            gc.enable()
        if not wait(observer.done, duration + LAST_QUERY_TIMEOUT_S - NODES_UP_AFTER_S) and launches.has_robot:
            wait(observer.done, START_TIMEOUT_S)
    except KeyboardInterrupt:
        observer.finish_early()


@contextlib.contextmanager
def _interrupted_by_signals() -> Generator[None]:
    """Raise `KeyboardInterrupt` for SIGTERM and SIGHUP too, unless they are ignored (`nohup`)."""

    def interrupt(_signum: int, _frame: object) -> None:
        raise KeyboardInterrupt

    names = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    before = {each: signal.getsignal(each) for each in names}
    for each, handler in before.items():
        if handler is not signal.SIG_IGN:
            signal.signal(each, interrupt)
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)
