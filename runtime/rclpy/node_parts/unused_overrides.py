"""Values of the command line that no node declares a parameter for: ROS 2 says nothing of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from bot_console.runtime.rmw.parameter_precedence import COMMAND_LINE

BY_PUBLISHERS = "qos_overrides."
"""Parameters with such names are declared when a publisher or a subscription is made."""


def unused_overrides(nodes: Iterable[Any]) -> Iterator[str]:
    """Yield a line for each value (`-p name:=value`) that is given to some of the nodes and declared by none."""
    given: dict[str, list[Any]] = {}
    declared: set[str] = set()
    for node in nodes:
        if node._allow_undeclared_parameters:
            return  # it may read any of them
        declared |= node._parameters.keys()
        for name, source in node._ros_override_sources.items():
            if source == COMMAND_LINE and not name.startswith(BY_PUBLISHERS):
                given.setdefault(name, []).append(node)
    for name, those in given.items():
        if name not in declared:
            yield f"-p {name}:=... sets nothing: {_who(those)} no parameter {name}{_meant(name, declared)}"


def _who(nodes: list[Any]) -> str:
    names = [each.get_fully_qualified_name() for each in nodes]
    return f"{names[0]} declares" if len(names) == 1 else f"{', '.join(names)} declare"


def _meant(name: str, declared: Iterable[str]) -> str:
    from difflib import get_close_matches  # imported late: only a mistyped name needs it

    near = get_close_matches(name, sorted(declared), 1)
    return f"; did you mean {near[0]}?" if near else ""
