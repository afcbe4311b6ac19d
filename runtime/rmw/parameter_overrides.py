"""Parameter overrides from outside, by node key and name, each kept per type until one is chosen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from bot_console.runtime.rmw.parameter_types import SCALARS

COMMAND_LINE = "-p"
"""The source of a value that the command line itself gives."""

Slots = dict[tuple[str, bool], Any]
"""What a parameter was given: (kind, whether a list) -> value. rcl keeps one value of each type beside the others."""


def chosen(slots: Slots) -> Any:
    """The value that counts among those of several types: scalars before lists; None where there is no value."""
    for is_list in (False, True):
        for kind in SCALARS:
            if (kind.word, is_list) in slots:
                value = slots[kind.word, is_list]
                return list(value) if is_list else value
    return None


class ParameterYamlError(ValueError):
    """A parameter file or value is refused; the message has the words of rcl. `mend` says more than they do."""

    def __init__(self, text: str, mend: str = "") -> None:
        super().__init__(text)
        self.mend = mend


class NodeOverrides:
    """The parameters under one node key. Names may repeat; the later one counts."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.values: list[Slots] = []
        self.sources: list[str] = []
        """What gave each one its value last: the path of a file, or `COMMAND_LINE`."""

        self.source = ""
        """What is being read."""

    def find(self, name: str) -> int:
        """The place of a parameter, which is added where it is missing."""
        if name not in self.names:
            self.names.append(name)
            self.values.append({})
            self.sources.append("")
        place = self.names.index(name)
        self.sources[place] = self.source
        return place

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        for name, slots in zip(self.names, self.values, strict=True):
            yield name, chosen(slots)


class ParameterOverrides:
    """Overrides by node key; keys keep the place where they appeared first."""

    def __init__(self) -> None:
        self.nodes: dict[str, NodeOverrides] = {}
        self.source = COMMAND_LINE
        """Where what is added comes from: the path of a file, or `COMMAND_LINE`."""

    def node(self, key: str) -> NodeOverrides:
        """The parameters under a node key, which is added where it is missing."""
        node = self.nodes.setdefault(key, NodeOverrides())
        node.source = self.source
        return node
