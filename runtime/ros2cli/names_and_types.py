"""Names in the graph with their types: which names verbs list, and how they print them."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from ros2cli.command import Result

NamesAndTypes = Sequence[tuple[str, Sequence[str]]]

SEND_GOAL = "/_action/send_goal"
GOAL_SUFFIX = "_SendGoal"


def visible_rows(rows: NamesAndTypes, include_hidden: bool) -> NamesAndTypes:
    """Return the rows sorted by name; hidden ones, which include the parts of actions, only if requested."""
    return sorted(row for row in rows if include_hidden or not topic_or_service_is_hidden(row[0]))


def action_names_and_types(services: NamesAndTypes) -> NamesAndTypes:
    """Return actions with their types, derived from the goal services among `services`."""
    return sorted(
        (name[: -len(SEND_GOAL)], [each.removesuffix(GOAL_SUFFIX) for each in types])
        for name, types in services
        if name.endswith(SEND_GOAL)
    )


def add_hidden_argument(kind: str, parser: argparse.ArgumentParser, **more: Any) -> None:
    """Add the option that includes hidden `topics` or `services`."""
    text = f"Consider hidden {kind} as well"
    parser.add_argument(f"--include-hidden-{kind}", action="store_true", help=text, **more)


def repeat_hidden_argument(kind: str, parser: argparse.ArgumentParser) -> None:
    """Accept that option after the verb, too; if it is missing there, the one before the verb applies."""
    add_hidden_argument(kind, parser, default=argparse.SUPPRESS)


def add_count_argument(kind: str, parser: argparse.ArgumentParser) -> None:
    """Add the option that prints only the number of `topics`, `services`, ..."""
    text = f"Only display the number of {kind} discovered"
    parser.add_argument("-c", f"--count-{kind}", action="store_true", help=text)


def print_names(rows: NamesAndTypes, with_types: bool) -> None:
    """Print a line for each name."""
    for name, types in rows:
        print(f"{name} [{', '.join(types)}]" if with_types else name)


def print_types(rows: NamesAndTypes, name: str) -> Result:
    """Print the types of a name; if there is none, the exit code is 1."""
    types = dict(rows).get(name)
    if types is None:
        return 1
    for each in types:
        print(each)
    return None


def print_found(rows: NamesAndTypes, wanted_type: str, count: bool) -> Result:
    """Print the names with a type, or their number."""
    found = [name for name, types in rows if wanted_type in types]
    if count:
        print(len(found))
        return None
    for name in found:
        print(name)
    return None
