"""`bot-console run`: runs a node as the main program of this process, or together with the console."""

from __future__ import annotations

import argparse
import sys

from bot_console.tui.cli.arguments import SIMULATOR_HELP, Options
from bot_console.tui.cli.machine_limits import no_node_here
from bot_console.tui.cli.numbers import positive, seed
from bot_console.tui.cli.program_launch import program_arguments
from bot_console.tui.cli.verbs import ros2
from bot_console.tui.session.embedded.domain import take_part
from bot_console.tui.session.embedded.reaching import named_routers, reach_system, report_left_router
from bot_console.tui.session.embedded.workspaces import PROGRAM_LAUNCH, report_workspace


def run(words: list[str]) -> int:
    """Run `[--watch | --headless ...] FILE.py | PACKAGE EXECUTABLE [--ros-args ...]`."""
    parser = _parser()
    given, rest = parser.parse_known_args(words[: _operand(words)])
    rest += words[_operand(words) :]
    report_workspace(rest[0] if rest else "")
    if rest and _is_for_python(rest[0]) and (given.watch or given.headless or given.prefix is not None):
        parser.error("-m and -c run alone in this terminal: leave out --prefix, --watch and --headless")
    if given.prefix is not None:
        if given.watch or given.headless:
            parser.error("--prefix is for a program in this terminal: leave out --watch and --headless")
        return _prefixed(given.prefix, rest)
    if not (given.watch or given.headless):
        from bot_console.runtime.programs.run import main

        problem = no_node_here() or (reach_system() if named_routers() else take_part())
        if problem:
            print(problem, file=sys.stderr)
            return 1
        return main(rest)
    if not rest:
        parser.error("name a file or a package: bot-console run --watch FILE.py, or PACKAGE EXECUTABLE")
    arguments, problem = program_arguments(rest, _hint)
    if problem:
        print(problem, file=sys.stderr)
        return 1
    options = _options(given, arguments)
    if given.headless:
        report_left_router()
        from bot_console.tui.cli.headless.run import run as run_headless

        return run_headless(options)
    from bot_console.tui.cli.open_console import run as show

    return show(options)


def _prefixed(prefix: str, words: list[str]) -> int:
    """Run an executable behind a command prefix, in a separate process."""
    report_left_router()
    problem = no_node_here() or take_part()
    if problem:
        print(problem, file=sys.stderr)
        return 1
    return ros2.main(["run", f"--prefix={prefix}", *words])


def _hint(text: str) -> None:
    print(f"[WARN] [bot-console]: {text}", file=sys.stderr)


def _options(given: argparse.Namespace, program_arguments: dict[str, str]) -> Options:
    return Options(
        launch=str(PROGRAM_LAUNCH),
        launch_arguments=program_arguments,
        simulator=given.simulator,
        world=given.world or "",
        headless=given.headless,
        fast=given.fast,
        duration=given.duration,
        seed=given.seed,
    )


def _operand(words: list[str]) -> int:
    """The number of words before the file or package."""
    index = 0
    while index < len(words) and words[index].startswith("-") and not _begins_program(words[index]):
        index += 2 if words[index] in ("--duration", "--prefix", "--seed", "--world") else 1
    return index


def _begins_program(word: str) -> bool:
    return word == "--ros-args" or _is_for_python(word)


def _is_for_python(word: str) -> bool:
    """Whether a word is an option of the interpreter that names the program: `-m MODULE`, `-c CODE`."""
    return word[:2] in ("-m", "-c")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "bot-console run",
        usage="bot-console run [options] FILE.py | -m MODULE | -c CODE | PACKAGE EXECUTABLE [--ros-args ...]",
        description="Run a node, alone in this terminal or with the console on it.",
    )
    add = parser.add_argument
    add("--prefix", metavar="COMMAND", help="command to put before the executable, in quotes if it has spaces")
    add("--watch", action="store_true", help="open the console on it")
    add("--headless", action="store_true", help="no console: logs on stderr, a JSON report on stdout at the end")
    add("--fast", action="store_true", help="with --headless: in simulated time, as fast as possible, reproducibly")
    add("--duration", type=positive, metavar="S", help="with --headless: seconds to run")
    add("--seed", type=seed, metavar="N", help="seed of the simulated world")
    add("--world", metavar="NAME", help="world of the simulated robot")
    add("--simulator", action=argparse.BooleanOptionalAction, help=SIMULATOR_HELP)
    return parser
