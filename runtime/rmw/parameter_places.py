"""In which line of which file a parameter was given a value: a parameter file, or a launch file through one."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_overrides import COMMAND_LINE

KEYWORD = "ros__parameters"
FROM_LAUNCH = "# from "
"""How a parameter file begins that launch has written for the values of a launch file; the action's place follows."""


def place_of(source: str, node: str, name: str) -> str:
    """The `file:line` that gives a node (full name) a parameter; the file alone, or empty, if no more is known.

    `source` is the path of a parameter file, or `COMMAND_LINE`.
    """
    if not source or source == COMMAND_LINE:
        return ""
    try:
        with open(source, encoding="utf-8") as file:
            text = file.read()
    except (OSError, ValueError):
        return ""
    first = text.partition("\n")[0]
    if first.startswith(FROM_LAUNCH):
        return _in_launch_file(first.removeprefix(FROM_LAUNCH), name)
    line = line_of_name(text, node, name)
    return f"{source}:{line}" if line else source


def place_of_key(path: str, key: str) -> str:
    """The `file:line` of a node's key in a parameter file; the file alone if it is not found."""
    try:
        with open(path, encoding="utf-8") as file:
            found = dict(node_keys(file.read()))
    except (OSError, ValueError):
        return path
    return f"{path}:{found[key]}" if key in found else path


def line_of_name(text: str, node: str, name: str) -> int:
    """The line of a parameter file's text that gives a node a parameter; 0 if none does."""
    lines = [line for key, found, line in _names(text) if found == name and key_matches(key, node)]
    return lines[-1] if lines else 0


def node_keys(text: str) -> Iterator[tuple[str, int]]:
    """The node keys of a parameter file's text, each with its line; none for a text that is not YAML."""
    for key, line, _ in _sections(_composed(text), "", 0):
        yield key, line


def _names(text: str) -> Iterator[tuple[str, str, int]]:
    """Node key, parameter name and line of each value."""
    for key, _, values in _sections(_composed(text), "", 0):
        yield from ((key, *each) for each in _flat(values, ""))


def _flat(mapping: object, prefix: str) -> Iterator[tuple[str, int]]:
    for name, value in _pairs(mapping):
        yield f"{prefix}{name.value}", name.start_mark.line + 1
        yield from _flat(value, f"{prefix}{name.value}.")


def _sections(mapping: object, key: str, line: int) -> Iterator[tuple[str, int, Any]]:
    """The sections below the keyword, each with its node's key and the line of that."""
    for name, value in _pairs(mapping):
        if name.value == KEYWORD:
            yield key, line, value
        else:
            yield from _sections(value, f"{key}/{name.value}" if key else str(name.value), name.start_mark.line + 1)


def _pairs(node: Any) -> Iterator[tuple[Any, Any]]:
    """Keys and values of a mapping of the tree; nothing for any other node."""
    if node is not None and node.id == "mapping":
        yield from node.value


@lru_cache(maxsize=8)
def _composed(text: str) -> Any:
    """The tree of a text; None if it is not YAML."""
    import yaml

    untyped: Any = yaml  # the stubs leave `compose` untyped
    try:
        return untyped.compose(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except (yaml.YAMLError, ValueError):
        return None


def _in_launch_file(origin: str, name: str) -> str:
    """The line that names a parameter: the first one from the action's own on, else the first one of the file."""
    path, _, start = origin.rpartition(":")
    if not start.isdigit():
        return origin
    word = re.compile(rf"(?<![\w.]){re.escape(name.rpartition('.')[2])}(?![\w.])")
    try:
        with open(path, encoding="utf-8") as file:
            named = [number for number, line in enumerate(file, 1) if word.search(line)]
    except (OSError, ValueError):
        return origin
    below = [number for number in named if number >= int(start)]
    return f"{path}:{(below or named or [start])[0]}"
