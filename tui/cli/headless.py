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
from typing import Any

from bot_console.runtime.importer import install
from bot_console.runtime.process import MAIN, NodeProcess, on_notice, stepped
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.workspaces import choose, launch_environment

ROOT = Path(__file__).resolve().parents[2]
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
        from bot_console.tui.cli.observer import Observer

        observer = Observer(duration)
        watching = NodeProcess("observer", clock)
        watching.start(observer.run, argv=["observer"])
        launch = NodeProcess("launch", clock)
        launch.start(
            lambda: sys.exit(_launch(options)),
            argv=["launch"],
            env=launch_environment(options.launch),
            stdout=_to_stderr,
            stderr=_to_stderr,
        )
        with contextlib.suppress(KeyboardInterrupt):
            _wait_for(observer, launch, clock.steady_ns() + round((duration + GRACE) * 1e9))
        report = observer.report()
        launch.stop(GRACE)
        watching.stop(GRACE)
        report["deterministic"] = bool(getattr(clock, "deterministic", False))
        stalls = getattr(clock, "stalls", [])
    report["wall_time"] = round(time.perf_counter() - began, 3)
    if stalls:
        report["stalls"] = stalls
    print(json.dumps(report, indent=2))
    return 0 if observer.complete else _no_report(launch)


def _no_report(launch: NodeProcess) -> int:
    ended = f"; the launch had ended with exit code {launch.exit_code}" if launch.exit_code is not None else ""
    print(f"no simulator has answered the question for its report{ended}; the log above says why", file=sys.stderr)
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


def _wait_for(observer: Any, launch: NodeProcess, deadline_ns: int) -> None:
    """Until the report is there, the launch has ended, or it is too late."""
    clock = MAIN.clock
    forget = launch.on_exit(lambda _: observer.done.set())
    try:
        observer.done.wait(max(0.0, (deadline_ns - clock.steady_ns()) * 1e-9))
    finally:
        forget()


def _launch(options: Options) -> int:
    """Run the launch file; in its own node process."""
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    from launch import LaunchDescription, LaunchService

    path = options.launch or str(ROOT / "launch" / "robot_system.launch.py")
    arguments = dict(options.launch_arguments)
    if not options.launch:
        arguments = {"profile": options.profile, **arguments}
        if options.seed is not None:
            arguments.setdefault("seed", str(options.seed))
    service = LaunchService(noninteractive=True)
    include = IncludeLaunchDescription(AnyLaunchDescriptionSource(path), launch_arguments=arguments.items())
    service.include_launch_description(LaunchDescription([include]))
    return service.run()


def _to_stderr(text: str) -> None:
    sys.__stderr__.write(text) if sys.__stderr__ else None
