"""The `tune` command: its options, a line for each setting, and printing and saving the result."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from bot_console.runtime.importer import install
from bot_console.tui.cli.arguments import add_profile_folders
from bot_console.tui.cli.numbers import integer, positive, seed
from bot_console.tui.cli.tune.pool import Pool
from bot_console.tui.cli.tune.results import result_data, result_line, tunables_of
from bot_console.tui.cli.tune.saving import save_profile
from bot_console.tui.files.folders import state_folder
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.session.embedded.named_profile import NoProfileError, named_profile
from bot_console.tui.tuning.job import Progress, TuningJob
from bot_console.tui.tuning.run_journal import TuningJournal
from bot_console.tui.tuning.score import BUILT_IN_SCORES, FIGURES, parse_score
from bot_console.tui.tuning.search import SEARCHES
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting, find_tunables

MAX_RUNS = 1_000_000
"""Maximum number of simulator runs; nobody waits for more."""
EPILOG = """\
predefined scores (higher is better):
{ready}
a formula is arithmetic over {figures},
and mean, least, greatest, last or rms of a topic's field: "mean_speed - rms(/odom/twist.twist.angular.z)"

examples:
  bot-console tune max_speed safety_distance
  bot-console tune max_speed=0.5..3 turn_rate --profile outdoor --runs 120 --save swift
  bot-console tune kp_angular --score "mean_speed - 2*collisions" --search grid --json

exit codes: 0 done, 1 failed or stopped, 2 wrong usage
"""


def run(words: Sequence[str]) -> int:
    """Run the command; 0 if there is a result, 1 if there is none, 2 for wrong usage."""
    parser = command_parser()
    given = parser.parse_args(words)
    arguments = dict(each.split(":=", 1) for each in given.parameters if ":=" in each)
    named = [each for each in given.parameters if ":=" not in each]
    try:
        score = parse_score(given.score)
    except ValueError as error:
        parser.error(f"--score: {error}")
    try:
        profile = named_profile(given.profile, given.profiles or ())
    except NoProfileError as error:
        parser.error(str(error))
    if profile.launch:
        parser.error(f"{given.profile} launches {profile.launch}: only a parameter file can be tuned")
    try:
        pool = Pool(given.jobs)
    except OSError as error:
        print(error, file=sys.stderr)
        return 1
    try:
        worlds = tuple(given.worlds.split(",")) if given.worlds else ("",)
        probes = [pool.probe(profile.path or profile.name, arguments, world) for world in worlds]
        systems = [each.result() for each in probes]
        if problem := next((each["problem"] for each in systems if each.get("problem")), ""):
            print(f"the system does not start: {problem}", file=sys.stderr)
            return 1
        specification = TuningSpecification(
            _parse_tunables(parser, named, systems[0]),
            score,
            profile=profile.path or profile.name,
            worlds=worlds,
            runs=given.runs,
            seeds=given.seeds,
            held_out=given.held_out,
            seed=given.seed,
            duration=given.duration,
            search=given.search,
            arguments=arguments,
        )
        if problem := specification.problem():
            parser.error(problem)
        progress = _run_job(specification, pool, given)
    finally:
        pool.close()
    return _print_result(specification, progress, given)


def _parse_tunables(parser: argparse.ArgumentParser, named: list[str], system: Mapping[str, Any]) -> Any:
    try:
        return find_tunables(named, tunables_of(system))
    except ValueError as error:
        parser.error(str(error))


def _run_job(specification: TuningSpecification, pool: Pool, given: argparse.Namespace) -> Progress:
    """Run the tuning job until it ends or until Ctrl-C; results stay in the journal."""
    journal = TuningJournal(state_folder() / "tune", specification, resume=given.resume)
    if given.resume:
        print(f"{journal.resumed} runs are already known", file=sys.stderr)
    job = TuningJob(specification, pool, journal, _event_reporter(specification))
    try:
        return job.run()
    except KeyboardInterrupt:
        print(f"\nstopped; --resume continues with the runs in {journal.path}", file=sys.stderr)
        return job.progress
    finally:
        journal.close()


def _event_reporter(specification: TuningSpecification) -> Callable[[Progress], None]:
    """Return a function that prints each setting once, and the progress, on stderr."""
    reported: set[Setting] = set()

    def report(progress: Progress) -> None:
        rest = "\r\033[K" if sys.stderr.isatty() else ""
        for each in progress.rows:
            if each.setting not in reported:
                print(f"{rest}{result_line(specification, each)}", file=sys.stderr)
                reported.add(each.setting)
        if rest and not progress.ended:
            left = f", {math.ceil(progress.left)} s left" if progress.left is not None else ""
            print(f"{rest}{progress.done} of {progress.runs} runs{left}", end="", file=sys.stderr, flush=True)
        elif rest:
            print(rest, end="", file=sys.stderr)

    return report


def _print_result(specification: TuningSpecification, progress: Progress, given: argparse.Namespace) -> int:
    """Print the result and save it; returns the exit code."""
    best = progress.best
    result = result_data(specification, progress)
    if given.json:
        print(json.dumps(result, indent=2))
    elif best is not None:
        print("\n".join(result["text"]))
    if best is None or progress.problem or not progress.ended:
        print(progress.problem or "stopped", file=sys.stderr)
        return 1
    if given.save:
        install()
        try:
            print(save_profile(given.save, specification, best), file=sys.stderr)
        except NotSaved as error:
            print(f"not saved: {error}", file=sys.stderr)
            return 1
    return 0


def command_parser() -> argparse.ArgumentParser:
    """The options of `tune`."""
    ready = "\n".join(f"  {name:8}{formula}\n{'':10}{what}" for name, (formula, what) in BUILT_IN_SCORES.items())
    parser = argparse.ArgumentParser(
        "bot-console tune",
        description="Run the simulator many times, and find the parameter values that score best.",
        epilog=EPILOG.format(ready=ready, figures=", ".join(FIGURES)),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add(
        "parameters",
        nargs="+",
        metavar="[NODE:]NAME[=LOW..HIGH]",
        help="parameter to tune; NAME:=VALUE: a launch argument",
    )
    add(
        "--score",
        default="swift",
        metavar="FORMULA",
        help=f"{', '.join(BUILT_IN_SCORES)}, or a formula; higher is better (default: swift)",
    )
    add("--runs", type=integer(1, MAX_RUNS), default=60, metavar="N", help="number of runs (default: 60)")
    add("--seeds", type=integer(1, MAX_RUNS), default=3, metavar="N", help="seeds for each setting (default: 3)")
    add(
        "--held-out",
        type=integer(0, MAX_RUNS),
        default=5,
        metavar="N",
        help="further seeds that check the best setting at the end (default: 5)",
    )
    add("--seed", type=seed, default=1, metavar="N", help="first seed (default: 1)")
    add("--duration", type=positive, default=60.0, metavar="S", help="simulated seconds of a run (default: 60)")
    add("--search", default="adaptive", choices=sorted(SEARCHES), help="how settings are chosen (default: adaptive)")
    add("--profile", default="indoor", metavar="PROFILE", help="profile to tune, by name or path (default: indoor)")
    add_profile_folders(parser)
    add("--worlds", default="", metavar="A,B", help="worlds for each setting; default: the profile's")
    add("--jobs", type=integer(0, MAX_RUNS), default=0, metavar="N", help="concurrent runs; default: one per processor")
    add("--resume", action="store_true", help="resume a tuning job that was stopped")
    add("--json", action="store_true", help="print the result as JSON")
    add("--save", default="", metavar="NAME", help="save the best setting as one of your profiles")
    return parser
