"""Parameter overrides given to a node, by node key and name, with one value per type until one of them is chosen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from bot_console.runtime.rmw.parameter_types import SCALARS

COMMAND_LINE = "-p"
"""The source of a value given on the command line itself."""

Slots = dict[tuple[str, bool], Any]
"""The values given for a parameter: (kind, whether a list) -> value. Like rcl, it keeps one value per type."""


def effective_value(slots: Slots) -> Any:
    """Return the effective value among those of several types: scalars before lists; None if there is none."""
    for is_list in (False, True):
        for kind in SCALARS:
            if (kind.word, is_list) in slots:
                value = slots[kind.word, is_list]
                return list(value) if is_list else value
    return None


class ParameterYamlError(ValueError):
    """A parameter file or value is invalid; the message has rcl's wording. `hint` adds how to fix it."""

    def __init__(self, text: str, hint: str = "") -> None:
        super().__init__(text)
        self.hint = hint


class NodeOverrides:
    """The parameters under one node key. Names may repeat; the last value counts."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.values: list[Slots] = []
        self.sources: list[str] = []
        """The source of each parameter's last value: the path of a file, or `COMMAND_LINE`."""

        self.source = ""
        """The source being read."""

    def find(self, name: str) -> int:
        """Return a parameter's index, adding it if missing."""
        if name not in self.names:
            self.names.append(name)
            self.values.append({})
            self.sources.append("")
        place = self.names.index(name)
        self.sources[place] = self.source
        return place

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        for name, slots in zip(self.names, self.values, strict=True):
            yield name, effective_value(slots)


class ParameterOverrides:
    """Parameter overrides by node key, in the order in which the keys first appear."""

    def __init__(self) -> None:
        self.nodes: dict[str, NodeOverrides] = {}
        self.source = COMMAND_LINE
        """The source of the values being added: the path of a file, or `COMMAND_LINE`."""

    def node(self, key: str) -> NodeOverrides:
        """Return the parameters under a node key, adding the key if it is missing."""
        node = self.nodes.setdefault(key, NodeOverrides())
        node.source = self.source
        return node
