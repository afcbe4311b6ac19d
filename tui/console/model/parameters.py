"""Parameters as the panes see them: types, descriptors, and the parameters of each node."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import TypeAlias

from bot_console.tui.console.model.range import Range
from bot_console.tui.console.parameters.described_unit import unit_in_description

Value: TypeAlias = "bool | int | float | str | tuple[bool | int | float | str | bytes, ...] | None"
"""A parameter's value; arrays are tuples, None is NOT_SET."""


def same(one: Value | bytes, other: Value | bytes) -> bool:
    """Whether two values are identical, type included; NaN equals itself."""
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(same(*pair) for pair in zip(one, other, strict=True))
    if isinstance(one, float) and isinstance(other, float) and math.isnan(one):
        return math.isnan(other)
    return type(one) is type(other) and one == other


class Kind(IntEnum):
    """Parameter types with the codes of `rcl_interfaces/msg/ParameterType`."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    @property
    def word(self) -> str:
        """The type word of `ros2 param` (`double`, `string array` ...)."""
        return "boolean" if self is Kind.BOOL else self.name.lower().replace("bool_", "boolean_").replace("_", " ")


@dataclass(frozen=True, slots=True)
class ParameterInfo:
    """One parameter of a node: its value and its descriptor."""

    node: str
    name: str
    kind: Kind
    value: Value
    description: str = ""
    read_only: bool = False
    dynamic: bool = False
    range: Range | None = None
    constraints: str = ""
    default: Value = None
    origin: str = ""
    """Where the value comes from, as text for users; empty if unknown."""

    declared_at: str = ""
    """The `file:line` of the declaration, whose value is then in `default`; empty if unknown."""

    @property
    def unit(self) -> str:
        """The unit in parentheses at the end of the description, such as `m/s`; empty if there is none."""
        return unit_in_description(self.description)

    @property
    def changed(self) -> bool:
        """Whether the value differs from the default."""
        return not same(self.value, self.default)


@dataclass(frozen=True, slots=True)
class ParameterTree:
    """The parameters of one node; `problem` says why they cannot be read, and is empty if they can."""

    node: str
    parameters: tuple[ParameterInfo, ...] = ()
    problem: str = ""
    ended: str = ""
    """When and how the node ended, after which it has no parameters; empty while it exists."""

    def get(self, name: str) -> ParameterInfo | None:
        """The parameter with that name; None if the node has none."""
        return next((each for each in self.parameters if each.name == name), None)


def parameter_in(trees: Mapping[str, ParameterTree], node: str, name: str) -> ParameterInfo | None:
    """The parameter with this name of one of several nodes; None if there is no such node or parameter."""
    tree = trees.get(node)
    return tree.get(name) if tree else None
