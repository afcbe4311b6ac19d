"""The origin of parameter values, as reported by the programs themselves and by launch.

There are two kinds of facts. `declared`: a node reports the parameters that it has declared, the line of each, and
which override applied. `given`: a launch reports the values that its file gives to a node, and whether by a launch
argument or directly.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

from bot_console.tui.console.model import ChangeSource, ParameterInfo, Value, same
from bot_console.tui.console.parameters.origin_text import SET_BY, START

COMMAND_LINE = "-p"
"""A node reports this as the source of a value from its command line; other sources are file paths or text."""
WRITTEN_BY_LAUNCH = "launch_params_"
"""The prefix of the files that launch writes for the values in a launch file."""
Learn = Callable[[str, Mapping[str, Any]], object]
"""Receives a fact: its kind and its content."""
Key = tuple[str, str]
"""A node and the name of one of its parameters."""


@dataclass(frozen=True, slots=True)
class Declaration:
    """The declaration of a parameter: the default, `file:line`, and what overrode the default (empty: nothing)."""

    default: Value
    place: str
    override: str
    start: Value = None
    """The resulting value, with which the node has started."""


class Provenance:
    """Collects all facts. `learn` may be called from any thread."""

    def __init__(self, profile_of: Callable[[str], str] = lambda path: "") -> None:
        """`profile_of` returns the name of the profile with this path; empty if there is none."""
        self._profile_of = profile_of
        self._declared: dict[Key, Declaration] = {}
        self._given: dict[Key, str] = {}

    def learn(self, kind: str, facts: Mapping[str, Any]) -> str:
        """Record a fact; returns the node that it concerns, or an empty text for another kind of fact."""
        node = str(facts.get("node", ""))
        if kind == "declared":
            for name, default, place, override, *start in facts["parameters"]:
                self._declared[node, name] = Declaration(_value(default), place, override, *map(_value, start))
            return node
        if kind == "given":
            self._given.update({(node, name): str(source) for name, source in facts["parameters"].items()})
            return node
        return ""

    def starts(self) -> Mapping[Key, Value]:
        """The start values of nodes, as far as they have reported them."""
        return {key: each.start for key, each in tuple(self._declared.items()) if each.start is not None}

    def applied(self, parameter: ParameterInfo) -> ParameterInfo:
        """A copy of a parameter with its declared default and the origin of its first value, if known."""
        key = parameter.node, parameter.name
        declared = self._declared.get(key)
        if declared is None or declared.default is None:
            default, place = parameter.default, declared.place if declared else ""
        else:
            default, place = declared.default, declared.place
        first = parameter.origin == START
        origin = self._origin(key, declared, parameter) if first else parameter.origin
        return replace(parameter, default=default, declared_at=place, origin=origin)

    def _origin(self, key: Key, declared: Declaration | None, parameter: ParameterInfo) -> str:
        if declared is None:
            return self._given.get(key, START)
        if declared.start is not None and not same(parameter.value, declared.start):
            return f"{SET_BY[ChangeSource.OTHER]} since the start"  # before this console saw it
        source = declared.override
        if not source:
            return "declared value" if same(parameter.value, declared.default) else START
        if source == COMMAND_LINE:
            return self._given.get(key, "command line")
        name = os.path.basename(source)
        if name.startswith(WRITTEN_BY_LAUNCH):
            return self._given.get(key, "launch file")
        if not os.path.isabs(source) and not os.path.exists(source):
            return source
        profile = self._profile_of(source)
        return f"profile {profile}" if profile else f"parameter file {source}"


def _value(reported: Any) -> Value:
    if not isinstance(reported, list):
        return reported
    return tuple(
        bytes([cast("dict[str, int]", each)["byte"]]) if isinstance(each, dict) else each
        for each in cast("list[Any]", reported)
    )
