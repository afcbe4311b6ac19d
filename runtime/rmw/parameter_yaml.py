"""Parameter values given from outside a node, by files and by `-p`, in the order of the command line."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

ALL_NODES = "/**"
"""The key of values that every node takes, such as those of a plain `-p name:=value`."""

BOOL, INTEGER, DOUBLE, STRING = "bool", "integer", "double", "string"
_SCALARS = {bool: BOOL, int: INTEGER, float: DOUBLE, str: STRING}
_KINDS = (BOOL, INTEGER, DOUBLE, STRING)

Slots = dict[tuple[str, bool], Any]
"""What a parameter was given: (kind, whether a list) -> value. rcl keeps one value of each type beside the others."""


def kind_of(value: Any) -> str:
    """The word of rcl for the type of a scalar."""
    return _SCALARS[type(value)]


def chosen(slots: Slots) -> Any:
    """The value that counts among those of several types: scalars before lists; None where there is no value."""
    for is_list in (False, True):
        for kind in _KINDS:
            if (kind, is_list) in slots:
                value = slots[kind, is_list]
                return list(value) if is_list else value
    return None


class ParameterYamlError(ValueError):
    """A parameter file or value is refused; the message has the words of rcl."""


class NodeOverrides:
    """The parameters under one node key. Names may repeat; the later one counts."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.values: list[Slots] = []

    def find(self, name: str) -> int:
        """The place of a parameter, which is added where it is missing."""
        try:
            return self.names.index(name)
        except ValueError:
            self.names.append(name)
            self.values.append({})
            return len(self.names) - 1

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        for name, slots in zip(self.names, self.values, strict=True):
            yield name, chosen(slots)


class ParameterTable:
    """All overrides of one command line; node keys keep the place where they appeared first."""

    def __init__(self) -> None:
        self.nodes: dict[str, NodeOverrides] = {}

    def node(self, key: str) -> NodeOverrides:
        """The parameters under a node key, which is added where it is missing."""
        return self.nodes.setdefault(key, NodeOverrides())

    def add_file(self, path: str) -> None:
        """Take the values of a parameter file; raises `ParameterYamlError`."""
        from bot_console.runtime.rmw.parameter_file import read_parameter_file

        # The checker knows this class under two names, by its path and by its package.
        read_parameter_file(path, self)  # pyright: ignore[reportArgumentType]

    def add_value(self, key: str, name: str, text: str) -> None:
        """Take the value of one parameter as `-p` writes it; raises `ParameterYamlError`."""
        from bot_console.runtime.rmw.parameter_value import read_parameter_value

        if not text:
            raise ParameterYamlError("error not set")
        node = self.node(key)
        read_parameter_value(text, node.values[node.find(name)])

    def for_node(self, fully_qualified_name: str) -> dict[str, Any]:
        """The values that reach a node; later keys overwrite earlier ones. None stands for a value without type."""
        found: dict[str, Any] = {}
        for key, node in self.nodes.items():
            if key_matches(key, fully_qualified_name):
                found.update(node)
        return found


def key_matches(key: str, fully_qualified_name: str) -> bool:
    """Whether a node key, with `*` for one name and `**` for any number of them, means this node."""
    if key == ALL_NODES:
        return True
    key = key if key.startswith("/") else f"/{key}"
    if "*" not in key:
        return key == fully_qualified_name
    pattern = key.replace("/*", r"(/\w+)")
    return re.fullmatch(pattern, fully_qualified_name) is not None
