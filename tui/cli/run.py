"""`bot-console run`: a node as the main program of this process, or with the console on it."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path

from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.workspaces import tell_whose

PROGRAM_LAUNCH = Path(__file__).resolve().parents[2] / "launch" / "program.launch.py"
WANTS_ROBOT = (b"cmd_vel", b"LaserScan", b"Odometry")
"""A file with one of these gets the simulated robot beside it."""


def run(words: list[str]) -> int:
    """Run `[--watch | --headless ...] FILE.py | PACKAGE EXECUTABLE [--ros-args ...]`."""
    parser = _parser()
    given, rest = parser.parse_known_args(words[: _operand(words)])
    rest += words[_operand(words) :]
    tell_whose(rest[0] if rest else "")
    if not (given.watch or given.headless):
        from bot_console.runtime.run import main

        return main(rest)
    if not rest or not Path(rest[0]).is_file():
        parser.error("--watch and --headless take a file: bot-console run --watch FILE.py")
    options = _options(given, Path(rest[0]).resolve(), rest[1:])
    if given.headless:
        from bot_console.tui.cli.headless import run as run_headless

        return run_headless(options)
    from bot_console.tui.cli.session import run as show

    return show(options)


def _options(given: argparse.Namespace, program: Path, words: list[str]) -> Options:
    simulator = given.simulator
    if simulator is None:
        text = program.read_bytes()
        simulator = any(each in text for each in WANTS_ROBOT)
    arguments = {"program": str(program), "words": shlex.join(words), "simulator": str(simulator).lower()}
    if given.world:
        arguments["world"] = given.world
    if given.seed is not None:
        arguments["seed"] = str(given.seed)
    return Options(
        launch=str(PROGRAM_LAUNCH),
        launch_arguments=arguments,
        headless=given.headless,
        fast=given.fast,
        duration=given.duration,
        seed=given.seed,
    )


def _operand(words: list[str]) -> int:
    """How many words stand before the file or package."""
    index = 0
    while index < len(words) and words[index].startswith("-") and words[index] != "--ros-args":
        index += 2 if words[index] in ("--duration", "--seed", "--world") else 1
    return index


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "bot-console run",
        usage="bot-console run [options] FILE.py | PACKAGE EXECUTABLE [--ros-args ...]",
        description="Run a node, alone in this terminal or with the console on it.",
    )
    add = parser.add_argument
    add("--watch", action="store_true", help="open the console on it")
    add("--headless", action="store_true", help="no screen: logs on stderr, a JSON report on stdout at the end")
    add("--fast", action="store_true", help="with --headless: simulated time, as fast as it goes, repeatable")
    add("--duration", type=float, metavar="S", help="with --headless: seconds to run")
    add("--seed", type=int, metavar="N", help="seed of the simulated world")
    add("--world", metavar="NAME", help="world of the simulated robot")
    add("--simulator", action=argparse.BooleanOptionalAction, help="whether the simulated robot runs beside it")
    return parser
