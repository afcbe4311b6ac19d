"""Names in the graph with their types: which of them verbs list, and how they print them."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from ros2cli.command import Result

NamesAndTypes = Sequence[tuple[str, Sequence[str]]]

SEND_GOAL = "/_action/send_goal"
GOAL_SUFFIX = "_SendGoal"


def visible(rows: NamesAndTypes, include_hidden: bool) -> NamesAndTypes:
    """Rows sorted by name, without hidden ones (and so without the parts of actions) unless asked for."""
    return sorted(row for row in rows if include_hidden or not topic_or_service_is_hidden(row[0]))


def action_names_and_types(services: NamesAndTypes) -> NamesAndTypes:
    """Actions with their types, derived from the goal services among the given services."""
    return sorted(
        (name[: -len(SEND_GOAL)], [each.removesuffix(GOAL_SUFFIX) for each in types])
        for name, types in services
        if name.endswith(SEND_GOAL)
    )


def add_hidden_argument(kind: str, parser: argparse.ArgumentParser, **more: Any) -> None:
    """Add the option to consider hidden `topics` or `services`."""
    text = f"Consider hidden {kind} as well"
    parser.add_argument(f"--include-hidden-{kind}", action="store_true", help=text, **more)


def repeat_hidden_argument(kind: str, parser: argparse.ArgumentParser) -> None:
    """Accept that option after the verb as well; if it is absent there, the one before the verb applies."""
    add_hidden_argument(kind, parser, default=argparse.SUPPRESS)


def add_count_argument(kind: str, parser: argparse.ArgumentParser) -> None:
    """Add the option to print only how many `topics`, `services`, ... there are."""
    text = f"Only display the number of {kind} discovered"
    parser.add_argument("-c", f"--count-{kind}", action="store_true", help=text)


def print_names(rows: NamesAndTypes, with_types: bool) -> None:
    """Print a line for each name."""
    for name, types in rows:
        print(f"{name} [{', '.join(types)}]" if with_types else name)


def print_types(rows: NamesAndTypes, name: str) -> Result:
    """Print the types that a name has; without any the exit code is 1."""
    types = dict(rows).get(name)
    if types is None:
        return 1
    for each in types:
        print(each)
    return None


def print_found(rows: NamesAndTypes, wanted_type: str, count: bool) -> Result:
    """Print the names that have a type, or how many there are."""
    found = [name for name, types in rows if wanted_type in types]
    if count:
        print(len(found))
        return None
    for name in found:
        print(name)
    return None
