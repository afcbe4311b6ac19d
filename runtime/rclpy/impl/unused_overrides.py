"""Reports values from the command line and from files that set nothing, about which ROS 2 is silent.

No node declares a parameter for such a value, or its file has no key for the node it was given to.
"""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator
from typing import TYPE_CHECKING, Protocol

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.programs.hints import at, is_read, key_of_another_node, nearest, not_declared
from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_places import place_of, place_of_key
from bot_console.runtime.rmw.parameter_precedence import COMMAND_LINE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bot_console.runtime.rmw.arguments import Arguments
    from bot_console.runtime.rmw.parameter_precedence import ParameterTable


class OverriddenNode(Protocol):
    """What this check needs of a node: its declared and given parameters."""

    @property
    def _allow_undeclared_parameters(self) -> bool: ...

    @property
    def _parameters(self) -> Mapping[str, object]: ...

    @property
    def _ros_arguments(self) -> Sequence[Arguments]: ...

    def get_fully_qualified_name(self) -> str:
        """Return namespace and name."""
        ...


class OverridingContext(Protocol):
    """What this check needs of a context: its nodes."""

    def tracked_nodes(self) -> Sequence[OverriddenNode]:
        """Return the nodes in this context."""
        ...


BY_PUBLISHERS = "qos_overrides."
"""Prefix of parameters that are declared when a publisher or subscription is created."""
HIDDEN_NODE_PREFIX = "_"
WRITTEN_BY_LAUNCH = "launch_params_"
"""Prefix of files that launch writes for one node."""


def report_unused_overrides(context: OverridingContext) -> None:
    """Give a notice of each value that sets nothing, if a person reads it; call this when spinning begins."""
    if is_read():
        for line in unused_overrides(context.tracked_nodes()):
            notify(current(), line)


def unused_overrides(nodes: Iterable[OverriddenNode]) -> Iterator[str]:
    """Yield a line for each value that is given to some of the nodes and declared by none.

    Values below a wildcard key of a file are left out: they are for many nodes, each of which may need only some.
    """
    given: dict[tuple[str, str], list[OverriddenNode]] = {}
    declared: set[str] = set()
    for node in nodes:
        if node._allow_undeclared_parameters:
            return  # this node may read any of them
        declared |= node._parameters.keys()
        for name, source in _meant_for(node):
            if not name.startswith(BY_PUBLISHERS):
                given.setdefault((name, source), []).append(node)
    for (name, source), those in given.items():
        if name not in declared:
            names = [each.get_fully_qualified_name() for each in those]
            what = f"-p {name}:=..." if source == COMMAND_LINE else f"{name}: ..."
            yield at(place_of(source, names[0], name), f"{what} {not_declared(names, name, declared)}")


def _meant_for(node: OverriddenNode) -> Iterator[tuple[str, str]]:
    """Yield name and source of each value that is meant for exactly this node."""
    full = node.get_fully_qualified_name()
    for arguments in node._ros_arguments:
        for key, values in arguments.parameters.nodes.items():
            for name, source in zip(values.names, values.sources, strict=True):
                own = os.path.basename(source).startswith(WRITTEN_BY_LAUNCH)
                if key_matches(key, full) and (source == COMMAND_LINE or own or "*" not in key):
                    yield name, source


def missed_files(table: ParameterTable, node: str, others: Collection[str]) -> Iterator[str]:
    """Yield a line for each file that has no key for a node (full name), but a key that seems to be mistyped.

    A file for many nodes may well omit one: a file is reported if a key that matches none of the process's `others`
    (full names) resembles the node's name, or is the only key of the file.
    """
    if node.rpartition("/")[2].startswith(HIDDEN_NODE_PREFIX):
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
    by_name = {key.rpartition("/")[2]: key for key in keys if "*" not in key}
    found = nearest(node.rpartition("/")[2], by_name)
    return by_name[found] if found else ""
