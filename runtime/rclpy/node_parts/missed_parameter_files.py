"""Warns of parameter files without effect, because none of their keys match a node: ROS 2 says nothing."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from bot_console.runtime.hints import at, key_of_another_node
from bot_console.runtime.rmw.parameter_places import place_of_key
from bot_console.runtime.rmw.parameter_precedence import COMMAND_LINE, key_matches

if TYPE_CHECKING:
    from bot_console.runtime.rmw.parameter_precedence import ParameterTable

HIDDEN = "_"


def missed_files(table: ParameterTable, node: str, others: Collection[str]) -> Iterator[str]:
    """Yield a line for each file that has no key for a node (full name), but one that seems to be mistyped.

    A file for many nodes may well omit one: a file is reported if a key that matches none of the process's `others`
    (full names) resembles the node's name, or is the only key of the file.
    """
    if node.rpartition("/")[2].startswith(HIDDEN):
        return
    for path, keys in _keys_by_file(table).items():
        if any(key_matches(key, node) for key in keys):
            continue
        free = [key for key in keys if not any(key_matches(key, each) for each in others)]
        near = _nearest(node, free) or (free[0] if len(keys) == 1 and free else "")
        if near:
            yield at(place_of_key(path, near), key_of_another_node(node, near))


def _keys_by_file(table: ParameterTable) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for key, values in table.nodes.items():
        for path in dict.fromkeys(values.sources):
            if path != COMMAND_LINE:
                found.setdefault(path, []).append(key)
    return found


def _nearest(node: str, keys: list[str]) -> str:
    from difflib import get_close_matches  # imported late: only a mistyped key needs it

    by_name = {key.rpartition("/")[2]: key for key in keys if "*" not in key}
    found = get_close_matches(node.rpartition("/")[2], by_name, 1)
    return by_name[found[0]] if found else ""
