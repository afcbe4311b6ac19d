"""`bot-console attach`: the console on a running system, be it embedded, this machine's ROS 2, or remote."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from bot_console.tui.cli.attach_options import AttachOptions, parse
from bot_console.tui.cli.terminal_check import NO_TERMINAL_TO_ATTACH, terminal_problem
from bot_console.tui.session.embedded.domain import others_take_part
from bot_console.tui.session.machine.choice import choose
from bot_console.tui.session.machine.console_needs import missing_messages, provide_missing
from bot_console.tui.session.machine.ros import run_ros
from bot_console.tui.session.network import run_network


def run(words: Sequence[str]) -> int:
    """Show the console on the chosen system; returns 2 if the choice is unclear and nobody can be asked."""
    options = parse(words)
    if options.network is not None:
        return _needs_terminal() or _network(options)
    kind = choose(ros=options.ros, embedded=options.embedded, system_there=others_take_part())
    if kind.code:
        print(kind.text, file=sys.stderr)
        return kind.code
    if kind.ros is not None:
        return _needs_terminal() or _ros(options, str(kind.ros))
    from bot_console.tui.cli.open_console import run as show

    return show(options.appearance)


def _needs_terminal() -> int:
    problem = terminal_problem(NO_TERMINAL_TO_ATTACH)
    if problem:
        print(problem, file=sys.stderr)
    return 1 if problem else 0


def _network(options: AttachOptions) -> int:
    return run_network(options)


def _ros(options: AttachOptions, place: str) -> int:
    missing = missing_messages()
    if missing:
        print(missing, file=sys.stderr)
        return 1
    provide_missing()
    return run_ros(options, place)
