"""Find the file and line that gave a parameter its value, in a parameter file or in the launch file that wrote it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_overrides import COMMAND_LINE

KEYWORD = "ros__parameters"
FROM_LAUNCH = "# from "
"""The first words of a parameter file that launch writes for values of a launch file; the action's place follows."""


def place_of(source: str, node: str, name: str) -> str:
    """Return the `file:line` where a node (full name) gets a parameter; the file alone, or empty, if that is all known.

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
    """Return the `file:line` of a node's key in a parameter file; the file alone if it is not found."""
    try:
        with open(path, encoding="utf-8") as file:
            found = dict(node_keys(file.read()))
    except (OSError, ValueError):
        return path
    return f"{path}:{found[key]}" if key in found else path


def line_of_name(text: str, node: str, name: str) -> int:
    """Return the line in a parameter file's text where a node gets a parameter; 0 if there is none."""
    lines = [line for key, found, line in _names(text) if found == name and key_matches(key, node)]
    return lines[-1] if lines else 0


def node_keys(text: str) -> Iterator[tuple[str, int]]:
    """Yield the node keys of a parameter file's text, each with its line; none for a text that is not YAML."""
    for key, line, _ in _sections(_yaml_tree(text), "", 0):
        yield key, line


def _names(text: str) -> Iterator[tuple[str, str, int]]:
    """Yield the node key, parameter name and line of each value."""
    for key, _, values in _sections(_yaml_tree(text), "", 0):
        yield from ((key, *each) for each in _flat(values, ""))


def _flat(mapping: object, prefix: str) -> Iterator[tuple[str, int]]:
    for name, value in _pairs(mapping):
        yield f"{prefix}{name.value}", name.start_mark.line + 1
        yield from _flat(value, f"{prefix}{name.value}.")


def _sections(mapping: object, key: str, line: int) -> Iterator[tuple[str, int, Any]]:
    """Yield the sections below the keyword `ros__parameters`, each with its node's key and the line of that key."""
    for name, value in _pairs(mapping):
        if name.value == KEYWORD:
            yield key, line, value
        else:
            yield from _sections(value, f"{key}/{name.value}" if key else str(name.value), name.start_mark.line + 1)


def _pairs(node: Any) -> Iterator[tuple[Any, Any]]:
    """Yield the keys and values of a mapping node; nothing for any other node."""
    if node is not None and node.id == "mapping":
        yield from node.value


@lru_cache(maxsize=8)
def _yaml_tree(text: str) -> Any:
    """Parse a text into a tree of YAML nodes; None if it is not YAML."""
    import yaml

    untyped: Any = yaml  # the stubs leave `compose` untyped
    try:
        return untyped.compose(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except (yaml.YAMLError, ValueError):
        return None


def _in_launch_file(origin: str, name: str) -> str:
    """Return the line that names a parameter: the first one from the action on, otherwise the first in the file."""
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
