"""`bot-console check SCRIPT`: carries out the steps of a script, and reports whether they went as expected."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.tui.cli.check.runner import Outcome, Runner
from bot_console.tui.cli.check.script import ScriptError, Step, read
from bot_console.tui.cli.check.stepped import StartError, read_start, run_stepped
from bot_console.tui.cli.numbers import seconds, seed
from bot_console.tui.session.embedded.workspaces import choose
from bot_console.tui.session.reached_console import reached_console, wait_until_known
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize

MAX_SCRIPT_BYTES = 1_000_000
"""Maximum size of a script."""
EPILOG = """one step per line, # starts a comment; a step that waits gives up after 5 s unless `within` says otherwise:
  set /robot_navigator max_speed 0.8
  expect-refused /robot_navigator max_speed 99 "out of range"
  expect /odom/twist.twist.linear.x > 0.1 within 10 s
  expect /robot_navigator:robot_name == "Bob"
  assert-rate /scan >= 9 for 3 s
  expect-node /safety_monitor        expect-no-node /ghost
  expect-topic /scan sensor_msgs/msg/LaserScan
  expect-log sev:>=warn obstacle within 20 s
  call /reset std_srvs/srv/Trigger
  wait 2 s
  stop

exit codes: 0 everything as expected, 1 something not as expected or nothing is running, 2 wrong usage or an unreadable
script
"""


def run(words: list[str]) -> int:
    """Parse the whole script, carry out its steps, print the report."""
    parser = argparse.ArgumentParser(
        "bot-console check",
        description="Set parameters, wait and check expectations on the system in this domain, for graders and CI.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "script", metavar="SCRIPT", help="file of steps; - reads them from standard input; with --course: a workspace"
    )
    parser.add_argument("--json", action="store_true", help="print the report as one JSON object")
    parser.add_argument("--stop", action="store_true", help="stop at the first step that fails")
    parser.add_argument(
        "--start",
        metavar="LINE",
        action="append",
        help="start this and carry out the steps on it alone, in simulated time: `run PACKAGE EXECUTABLE` or `launch "
        "PACKAGE FILE`; may be repeated",
    )
    parser.add_argument("--seed", type=seed, default=1, metavar="N", help="with --start: seed of the run (default: 1)")
    parser.add_argument("--course", metavar="COURSE", help="grade the workspace SCRIPT by the rows of a course")
    parser.add_argument("--junit", metavar="FILE", help="with --course: also write a report in JUnit's format")
    parser.add_argument(
        "--allow-network",
        action="store_true",
        help="with --course: grade even where programs cannot be isolated from the network",
    )
    parser.add_argument(
        "--wait", type=seconds, default=10.0, metavar="S", help="seconds to wait for nodes (default: 10)"
    )
    given = parser.parse_args(words)
    if not given.script:
        parser.error("name a script")
    if given.course is not None:
        from bot_console.tui.cli.check.grade import run_grading

        return run_grading(given)
    try:
        steps = read(_text(given.script))
    except (OSError, UnicodeDecodeError, ScriptError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        print(f"{given.script} cannot be used: {sanitize(str(reason))}", file=sys.stderr)
        return 2
    outcomes = _run_stepped(steps, given) if given.start else _run_live(steps, given)
    if outcomes is None:
        return 1
    if given.json:
        print(json.dumps(report(given.script, steps, outcomes), indent=2))
    else:
        print(summary(steps, outcomes))
    return 0 if len(outcomes) == len(steps) and not any(each.why for each in outcomes) else 1


def _run_live(steps: Sequence[Step], given: argparse.Namespace) -> list[Outcome] | None:
    """Carry out the steps on the system in this domain; if there is none, print why and return None."""
    with reached_console() as console:
        if console is None:
            return None
        if not wait_until_known(console, given.wait):
            print("no node is running in this domain; `bot-console up` starts the robot", file=sys.stderr)
            return None
        return _run_steps(Runner(console), steps, print_progress=not given.json, stop=given.stop)


def _run_stepped(steps: Sequence[Step], given: argparse.Namespace) -> list[Outcome] | None:
    """Carry out the steps on what `--start` starts; if that fails, print why and return None."""
    install()
    choose([])
    try:
        starts = [read_start(each) for each in given.start]
    except StartError as error:
        print(sanitize(str(error)), file=sys.stderr)
        return None
    outcomes = run_stepped(steps, starts, given.seed, given.wait, stop=given.stop)
    if not given.json:
        print("\n".join(map(step_line, outcomes)))
    return outcomes


def _text(script: str) -> str:
    if script == "-":
        return sys.stdin.read(MAX_SCRIPT_BYTES)
    with Path(script).open("rb") as file:
        content = file.read(MAX_SCRIPT_BYTES + 1)
    if len(content) > MAX_SCRIPT_BYTES:
        raise ScriptError(f"larger than the limit of {MAX_SCRIPT_BYTES} bytes")
    return content.decode("utf-8")


def _run_steps(runner: Runner, steps: Sequence[Step], *, print_progress: bool, stop: bool) -> list[Outcome]:
    outcomes: list[Outcome] = []
    for step in steps:
        outcome = runner.run(step)
        outcomes.append(outcome)
        if print_progress:
            print(step_line(outcome), flush=True)
        if stop and outcome.why:
            break
    return outcomes


def step_line(outcome: Outcome) -> str:
    """A step on one line; if it failed, the reason on a second one."""
    step = outcome.step
    head = f"{'FAIL' if outcome.why else 'ok  '} {step.line:>4}  {sanitize(step.text)}"
    return f"{head}\n           {sanitize(outcome.why)}" if outcome.why else head


def summary(steps: Sequence[Step], outcomes: Sequence[Outcome]) -> str:
    """The numbers of steps that succeeded, failed and were not run."""
    failed = sum(bool(each.why) for each in outcomes)
    left = len(steps) - len(outcomes)
    parts = [f"{len(outcomes) - failed} of {counted(len(steps), 'step')} as expected"]
    return ", ".join(parts + ([f"{failed} not"] if failed else []) + ([f"{left} not done"] if left else []))


def report(script: str, steps: Sequence[Step], outcomes: Sequence[Outcome]) -> dict[str, object]:
    """The report as JSON data."""
    failed = sum(bool(each.why) for each in outcomes)
    return {
        "script": script,
        "passed": len(outcomes) - failed,
        "failed": failed,
        "not_done": len(steps) - len(outcomes),
        "steps": [
            {
                "line": each.step.line,
                "text": each.step.text,
                "ok": not each.why,
                "why": each.why,
                "seconds": round(each.seconds, 3),
            }
            for each in outcomes
        ],
    }
