"""`bot-console reset`: resets parameters, robot and world to their initial state; the robot stays locked."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from concurrent.futures import Future
from concurrent.futures import TimeoutError as TooLate
from typing import TypeVar

from bot_console.tui.cli.verbs.stop import ask
from bot_console.tui.console.model import ConsoleSnapshot, Value
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.reached_console import reached_console, wait_until_known
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text

T = TypeVar("T")
ANSWER_TIMEOUT_S = 10.0
"""Seconds to discover what is running, and for each answer."""
TRIGGER = "std_srvs/srv/Trigger"
REASON = "the system is being reset"

Values = dict[str, dict[str, Value]]


def run(words: list[str]) -> int:
    """Lock the robot, restore parameters, reset simulators; returns 0 if all of that succeeded."""
    parser = argparse.ArgumentParser(
        "bot-console reset",
        description="Reset the running system: the robot is locked, parameters get the values with which their "
        "nodes started (all or none), and simulators their initial pose. `bot-console release` releases the robot.",
    )
    parser.add_argument("--dry-run", action="store_true", help="only print what would be reset")
    given = parser.parse_args(words)
    with reached_console(learning=True) as console:
        if console is None:
            return 1
        if not wait_until_known(console, ANSWER_TIMEOUT_S):
            print("there is no node to reset", file=sys.stderr)
            return 1
        return _reset(console, dry=given.dry_run)


def _reset(console: RosConsole, *, dry: bool) -> int:
    snapshot = console.snapshot()
    moved, untold = differing(snapshot, console.start_values())
    if dry:
        _report(moved, snapshot)
        return 0
    good = _lock()
    good = _restore(console, moved, snapshot) and good
    for service in reset_services(snapshot):
        answer = _wait(console.topics.call_service(service, TRIGGER, {}))
        message = answer.text if answer else "no answer"
        print(f"{service}: {sanitize(message)}")
        good = good and answer is not None and answer.ok
    if untold:
        nodes = ", ".join(map(sanitize, untold))
        print(f"not reset, since their initial values are unknown: {nodes}", file=sys.stderr)
    return 0 if good else 1


def _lock() -> bool:
    """Lock the robot, so that it does not act on values in transit; returns whether that is confirmed or unnecessary.

    It is the same lock as that of `bot-console stop`, so that the same person's `bot-console release` releases it.
    """
    held, info = ask("stop", REASON)
    if not info.locks:
        print("no robot with an emergency stop was found, so none is locked", file=sys.stderr)
        return True
    print("the robot is locked; bot-console release releases it" if held else "stop sent, not confirmed")
    return held


def _restore(console: RosConsole, moved: Values, snapshot: ConsoleSnapshot) -> bool:
    outcomes = _wait(console.parameters.set_all(moved, by="reset")) if moved else ()
    refused = [each for each in outcomes or () if not each.accepted]
    if outcomes is None or refused:
        for each in refused:
            print(f"{each.node} {each.name}: {sanitize(each.reason)}", file=sys.stderr)
        print("no parameter was reset", file=sys.stderr)
        return False
    _report(moved, snapshot)
    return True


def _report(moved: Values, snapshot: ConsoleSnapshot) -> None:
    for node, values in moved.items():
        for name, value in values.items():
            parameter = snapshot.parameters[node].get(name)
            before = value_text(parameter.value) if parameter else ""
            print(sanitize(f"{node} {name}: {before} -> {value_text(value)}"))
    count = sum(len(each) for each in moved.values())
    print(
        f"{counted(count, 'parameter')} differed from the initial values"
        if count
        else "all parameters have their initial values"
    )


def differing(snapshot: ConsoleSnapshot, starts: Mapping[tuple[str, str], Value]) -> tuple[Values, list[str]]:
    """The values to restore, by node, and the nodes that have not reported their start values."""
    moved: Values = {}
    untold: list[str] = []
    for node, tree in snapshot.parameters.items():
        if tree.parameters and not any((node, each.name) in starts for each in tree.parameters):
            untold.append(node)
        for each in tree.parameters:
            start = starts.get((node, each.name))
            if start is not None and start != each.value and not each.read_only:
                moved.setdefault(node, {})[each.name] = start
    return moved, untold


def reset_services(snapshot: ConsoleSnapshot) -> list[str]:
    """The services that reset a simulator: those next to a service that pauses it."""
    names = {each.name: each.types for each in snapshot.graph.services}
    return [
        name
        for name, types in sorted(names.items())
        if name.endswith("/reset") and TRIGGER in types and f"{name.removesuffix('reset')}pause" in names
    ]


def _wait(answer: Future[T]) -> T | None:
    try:
        return answer.result(ANSWER_TIMEOUT_S)
    except TooLate:
        return None
