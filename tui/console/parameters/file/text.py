"""Parses the text of parameter files as ROS does, and writes values so that ROS reads them back unchanged."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from collections.abc import Mapping as Map
from dataclasses import dataclass
from typing import Any, TypeAlias

import yaml
from bot_console.tui.console.model import Value
from bot_console.tui.console.parameters.file.yaml_tree import Mapping, Scalar, Sequence, YamlTree, read_tree
from bot_console.tui.text.yaml_flow import is_plain

KEYWORD = "ros__parameters"
NOTHING = f"it sets nothing; parameters belong below 'node_name: {KEYWORD}:'"
SMALLEST = 2.0**-1022
"""The smallest positive double that ROS can read from text."""

Places: TypeAlias = Map[str, "Scalar | Sequence"]
"""The position of each parameter's value, by full name."""

_SafeDumper: Any = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
_TRUE = frozenset(("Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"))
_FALSE = frozenset(("N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"))
_INTEGER = re.compile(r"[+-]?(?:0[xX][0-9a-fA-F]{1,20}|0[0-7]{0,30}|[1-9][0-9]{0,30})", re.ASCII)
_DOUBLE = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?", re.ASCII)
_NOT_FINITE = re.compile(r"\.(?:nan|NaN|NAN)|[+-]?\.(?:inf|Inf|INF)|[+-]?(?i:inf|infinity|nan)")


@dataclass(frozen=True)
class Section:
    """The parameters below one node key of a file, such as `/robot` or `/**`."""

    key: str
    mapping: Mapping
    places: Places


def sections(text: str) -> list[Section]:
    """The node sections of a parameter file in their order; none if the text has no content.

    Raises `ValueError`, with the line, for a text that ROS does not accept as a parameter file.
    """
    root = read_tree(text)
    if root is None:
        return []
    if not isinstance(root, Mapping):
        kind = "a list" if isinstance(root, Sequence) else "only text"
        raise ValueError(f"it contains {kind}; parameters belong below 'node_name: {KEYWORD}:'")
    found = list(_sections("", root))
    if not found:
        raise ValueError(NOTHING)
    return found


def _sections(space: str, mapping: Mapping) -> Iterator[Section]:
    for key, below in mapping.entries:
        if key.text == KEYWORD:
            if not space:
                raise ValueError(f"line {key.line}: there is no node name above '{KEYWORD}:'")
            if not isinstance(below, Mapping):
                raise ValueError(f"line {below.line}: there are no 'name: value' lines below '{KEYWORD}:' of {space}")
            yield Section(space, below, _unique(_places("", below)))
        elif key.text.startswith("ros_parameters"):
            raise ValueError(f"line {key.line}: '{key.text}' should be '{KEYWORD}', with two underscores")
        elif isinstance(below, Mapping):
            yield from _sections(f"{space.rstrip('/')}/{key.text.strip('/')}", below)
        else:
            raise ValueError(f"line {key.line}: '{key.text}' is not a parameter: it is not below '{KEYWORD}:'")


def _unique(places: Iterator[tuple[str, Scalar | Sequence]]) -> Places:
    found: dict[str, Scalar | Sequence] = {}
    for name, place in places:
        if name in found:
            raise ValueError(f"line {place.line}: '{name}' appears for the second time")
        found[name] = place
    return found


def _places(prefix: str, mapping: Mapping) -> Iterator[tuple[str, Scalar | Sequence]]:
    for key, below in mapping.entries:
        if isinstance(below, Mapping):
            yield from _places(f"{prefix}{key.text}.", below)
        else:
            yield prefix + key.text, below


def value_at(name: str, place: YamlTree) -> Value:
    """The value at a position; raises `ValueError`, with the line, if it is not valid in ROS."""
    if isinstance(place, Scalar):
        if place.missing:
            raise ValueError(f"line {place.line}: {name} has no value")
        return place.text if place.quoted else plain_value(place.text)
    found = place.elements if isinstance(place, Sequence) else ()
    elements: tuple[Any, ...] = tuple(value_at(name, each) for each in found if isinstance(each, Scalar))
    if isinstance(place, Mapping) or len(elements) < len(found):
        raise ValueError(f"line {place.line}: {name} contains a list or a mapping in a list")
    if len(set(map(type, elements))) > 1:
        raise ValueError(f"line {place.line}: the elements of {name} are not of one type")
    return elements


def plain_value(text: str) -> bool | int | float | str:
    """Parse an unquoted scalar as ROS does: there are no dates, no `1:30` and no null, but `1e3` is a number."""
    if text in _TRUE or text in _FALSE:
        return text in _TRUE
    if _INTEGER.fullmatch(text):
        value = int(text, _base(text.lstrip("+-")))
        if -(2**63) <= value < 2**63:
            return value
    if _DOUBLE.fullmatch(text):
        number = float(text)
        # A subnormal double is out of range for C's strtod, so ROS reads such a number as text.
        return text if math.isinf(number) or 0 < abs(number) < SMALLEST else number
    return float(text.lstrip(".").replace("-.", "-").replace("+.", "")) if _NOT_FINITE.fullmatch(text) else text


def _base(digits: str) -> int:
    """The base that C's `strtol` derives from the first digits."""
    if digits[:2] in ("0x", "0X"):
        return 16
    return 8 if digits[0] == "0" else 10


class _Dumper(_SafeDumper):
    """Quotes every text that a YAML dialect of ROS could take for something else."""


def _represent_text(dumper: Any, text: str) -> Any:
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=None if is_plain(text) else '"')


_Dumper.add_representer(str, _represent_text)


def block_text(key: str, value: Value | Map[str, Any]) -> str:
    """A key and its value as block-style YAML, as `ros2 param dump` writes it; ends with a newline."""
    return yaml.dump(
        {key: list(value) if isinstance(value, tuple) else value},
        Dumper=_Dumper,
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=False,
        width=10**9,
    )


def inline_text(value: Value | bytes | Map[str, Any]) -> str:
    """A value as it is written after a key, on one line."""
    data = list(value) if isinstance(value, tuple) else value
    text = yaml.dump(data, Dumper=_Dumper, default_flow_style=True, allow_unicode=True, sort_keys=False, width=10**9)
    return text.removesuffix("\n").removesuffix("\n...")
