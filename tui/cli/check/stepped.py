"""`bot-console check SCRIPT --start ...`: starts programs and runs the steps in simulated time with a fixed seed."""

from __future__ import annotations

import os
import shlex
import tempfile
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.check.runner import Outcome, Runner
from bot_console.tui.cli.check.script import Step
from bot_console.tui.session.embedded.named_launch import with_launch_file

LINK_TIMEOUT_S = 10.0
"""Simulated seconds to wait for the console's connection."""
NOT_REACHED = "not reached: "
"""Prefix of the reason for a step that was not carried out because the run had ended."""
STARTS = ("run", "launch")
USAGE = "write `run PACKAGE EXECUTABLE [ARGUMENT ...]` or `launch PACKAGE FILE [NAME:=VALUE ...]`"
HEAD = """\
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
"""


class StartError(ValueError):
    """A program cannot be started; the message says why."""


@dataclass(frozen=True)
class Start:
    """What to start: a launch file or an executable of a package, with arguments."""

    launch_file: str = ""
    package: str = ""
    executable: str = ""
    arguments: tuple[str, ...] = ()

    def action(self) -> str:
        """The source text of the launch action that starts it."""
        if not self.launch_file:
            names = f"package={self.package!r}, executable={self.executable!r}, output='screen'"
            return f"Node({names}, arguments={[*self.arguments]!r})"
        pairs = [tuple(each.split(":=", 1)) for each in self.arguments]
        return f"IncludeLaunchDescription({self.launch_file!r}, launch_arguments={pairs!r})"


def read_start(line: str) -> Start:
    """Parse `run ...` or `launch ...`; raises `StartError`."""
    try:
        verb, *words = shlex.split(line) or [""]
    except ValueError as error:
        raise StartError(f"{line}: {error}") from None
    if verb not in STARTS or len(words) < 2:
        raise StartError(f"{line}: {USAGE}")
    if verb == "run":
        return Start(package=words[0], executable=words[1], arguments=tuple(words[2:]))
    if any(":=" not in each for each in words[2:]):
        raise StartError(f"{line}: {USAGE}")
    found, problem = with_launch_file(Options(launch=words[0], launch_file=words[1]))
    if problem:
        raise StartError(f"{line}: {problem}")
    return Start(launch_file=found.launch, arguments=tuple(words[2:]))


class StepRunner:
    """Carries out the steps within a stepped run; it takes the place of the `Observer` that asks for the report."""

    def __init__(self, steps: Sequence[Step], wait_s: float, *, stop: bool) -> None:
        """`wait_s` is the time (simulated s) to wait for nodes; with `stop`, stop at the first step that fails."""
        self._steps, self._wait_s, self._stop = steps, wait_s, stop
        self.outcomes: list[Outcome] = []
        self.done = threading.Event()
        self.complete = False

    def run(self) -> None:
        """The main function of the node process."""
        from bot_console.tui.console.ros_console import RosConsole
        from bot_console.tui.session.reached_console import wait_until_known

        console = RosConsole()
        console.start()
        try:
            console.wait_ready(LINK_TIMEOUT_S)
            wait_until_known(console, self._wait_s)
            runner = Runner(console, time.monotonic, time.sleep)
            for each in self._steps:
                self.outcomes.append(runner.run(each))
                if self._stop and self.outcomes[-1].why:
                    break
            self.complete = True
        except KeyboardInterrupt:
            pass  # All nodes have ended.
        finally:
            console.close()
            self.done.set()

    def finish_early(self) -> None:
        """Do nothing: the steps end by themselves."""

    def report(self) -> dict[str, Any]:
        """Return an empty report; the results are in `outcomes`."""
        return {}


def run_stepped(
    steps: Sequence[Step], starts: Sequence[Start], seed: int, wait_s: float, *, stop: bool
) -> list[Outcome]:
    """Start the programs, carry out the steps, and end everything; `install` must have been called before."""
    from bot_console.tui.cli.headless.run import run_simulation

    checker = StepRunner(steps, wait_s, stop=stop)
    with tempfile.TemporaryDirectory(prefix="bc-check-") as folder:
        file = Path(folder) / "check.launch.py"
        actions = "".join(f"        {each.action()},\n" for each in starts)
        file.write_text(f"{HEAD}{actions}    ])\n", encoding="utf-8")
        seconds = wait_s + LINK_TIMEOUT_S + sum(each.seconds for each in steps)
        options = Options(launch=os.fspath(file), fast=True, seed=seed, duration=2 * seconds, simulator=False)
        _, _, launches = run_simulation(options, checker)
    if checker.complete:
        return checker.outcomes
    why = f"{NOT_REACHED}{launches.died or 'all nodes have ended'}"
    return [*checker.outcomes, *(Outcome(each, why, 0.0) for each in steps[len(checker.outcomes) :])]
