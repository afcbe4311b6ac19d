"""The parser of `ros2 <command> <verb>` and its exit codes."""

from __future__ import annotations

import argparse
import importlib
import os
import signal
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from bot_console.runtime.programs.exit_messages import Interrupted, ended_code, place_fault
from ros2cli.advice import advise, usage
from ros2cli.command import Command, Result, Verb

if TYPE_CHECKING:
    from pathlib import Path

COMMANDS: Mapping[str, tuple[str, str]] = {
    "action": ("ros2cli.verbs.action", "Various action related sub-commands"),
    "component": ("ros2cli.verbs.component", "Various component related sub-commands"),
    "interface": ("ros2cli.verbs.interface", "Show information about ROS interfaces"),
    "launch": ("ros2cli.verbs.launch", "Run a launch file"),
    "lifecycle": ("ros2cli.verbs.lifecycle", "Various lifecycle related sub-commands"),
    "node": ("ros2cli.verbs.node", "Various node related sub-commands"),
    "param": ("ros2cli.verbs.param", "Various param related sub-commands"),
    "pkg": ("ros2cli.verbs.pkg", "Various package related sub-commands"),
    "run": ("ros2cli.verbs.run", "Run a package specific executable"),
    "service": ("ros2cli.verbs.service", "Various service related sub-commands"),
    "topic": ("ros2cli.verbs.topic", "Various topic related sub-commands"),
}
"""The module and description of each command; a module is imported when its command is used."""

WRONG_USAGE = 2
"""The exit code of argparse."""


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """argparse's formatter without its import of shutil for the terminal's width, as each parser creates several."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, width=_columns() - 2)


def _columns() -> int:
    """Return the width of the terminal in columns, as `shutil.get_terminal_size` determines it."""
    reported = os.environ.get("COLUMNS", "")
    if reported.isdecimal() and int(reported):
        return int(reported)
    try:
        found = os.get_terminal_size(sys.__stdout__.fileno()).columns if sys.__stdout__ else 0
    except (ValueError, OSError):  # closed, or not a terminal
        found = 0
    return found or 80


def main(argv: Sequence[str] | None = None, prefixes: Sequence[Path] = ()) -> int:
    """Run a command line, given without the word `ros2`, and return its exit code. Prints to this process's streams.

    With an `rclpy` that is not ours, `prefixes` are those of its packages.
    """
    if prefixes:
        from bot_console.runtime.rosidl.texts import use_prefixes  # reads files, which most verbs do not

        use_prefixes(prefixes)
    words = list(sys.argv[1:] if argv is None else argv)
    try:
        return _finish(_run(words))
    except SystemExit as stop:
        if stop.code == WRONG_USAGE:
            advise(partial(usage, words))
        return stop.code if isinstance(stop.code, int) else 1 if stop.code else 0
    except KeyboardInterrupt:
        return Interrupted(signal.SIGINT)
    except BrokenPipeError:  # the reader has closed the pipe: no fault, and silent if run from a shell
        raise
    except RuntimeError as error:  # includes errors of the client library
        return _finish(str(error))
    except Exception as error:  # boundary of a verb: upstream ends with this traceback, a console continues
        if code := ended_code(error):
            return code
        if fault := place_fault(error):
            return _finish(fault)
        import traceback

        traceback.print_exc()
        return 1


def _run(words: list[str]) -> Result:
    parser = top_parser()
    name = next((word for word in words if not word.startswith("-")), "")
    command = load(name)
    if command is None:
        names = _all_commands(parser)
        for each in sorted(COMMANDS):
            names.add_parser(each)
        parser.parse_args(words)
        parser.print_help()
        return 0
    subparser = add_command(parser, command, words)
    arguments = parser.parse_args(words)
    if command.main:
        arguments.parser = subparser
        return command.main(arguments)
    verb: Verb | None = getattr(arguments, "_verb", None)
    if verb is None:
        subparser.print_help()
        return 0
    return verb.main(arguments)


def _finish(result: Result) -> int:
    if isinstance(result, str):
        print(result, file=sys.stderr)
        return 1
    return result or 0


def load(name: str) -> Command | None:
    """Return the command with that name, or None if there is none."""
    return importlib.import_module(COMMANDS[name][0]).COMMAND if name in COMMANDS else None


def top_parser() -> argparse.ArgumentParser:
    """Return the parser of `ros2` without any command."""
    parser = argparse.ArgumentParser(
        "ros2",
        description="ros2 is an extensible command-line tool for ROS 2.",
        formatter_class=HelpFormatter,
    )
    parser.add_argument("--use-python-default-buffering", action="store_true", help="Do not force line buffering.")
    return parser


def _subparsers(
    parser: argparse.ArgumentParser, of: str, rows: Mapping[str, str]
) -> argparse._SubParsersAction[argparse.ArgumentParser]:  # pyright: ignore[reportPrivateUsage] -- argparse has no public name for it
    width = max(map(len, rows), default=0)
    listing = "\n".join(f"{name.ljust(width)}  {text}" for name, text in sorted(rows.items()))
    return parser.add_subparsers(
        title="Commands", description=listing, metavar=f"Call `{of} <command> -h` for more detailed usage."
    )


def _all_commands(
    parser: argparse.ArgumentParser,
) -> argparse._SubParsersAction[argparse.ArgumentParser]:  # pyright: ignore[reportPrivateUsage] -- argparse has no public name for it
    return _subparsers(parser, "ros2", {name: text for name, (_, text) in COMMANDS.items()})


def add_command(parser: argparse.ArgumentParser, command: Command, words: Sequence[str]) -> argparse.ArgumentParser:
    """Add a command's parser with all its verbs, and the arguments of the verbs that `words` may call."""
    commands = _all_commands(parser)
    subparser = commands.add_parser(command.name, description=command.description, formatter_class=HelpFormatter)
    command.arguments(subparser)
    if command.verbs:
        verbs = _subparsers(subparser, f"ros2 {command.name}", {each.name: each.description for each in command.verbs})
        for verb in command.verbs:
            leaf = verbs.add_parser(verb.name, description=verb.description, formatter_class=HelpFormatter)
            leaf.set_defaults(_verb=verb, parser=leaf)
            if verb.name in words:
                verb.arguments(leaf)
    return subparser
