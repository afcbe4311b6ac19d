"""Saving parameters as a true ROS parameter file; an existing file is patched, so that its comments stay."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias, cast

import yaml
from bot_console.tui.console.model import ParameterTree, Value

Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_SafeDumper: Any = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
KEYWORD = "ros__parameters"
BUILT_IN = ("use_sim_time", "start_type_description_service")

PLAIN = re.compile(r"[A-Za-z_/](?:[\w/. -]*[\w/.-])?", re.ASCII)
WORDS = frozenset({"y", "n", "yes", "no", "on", "off", "true", "false", "null", "nan", "inf"})
"""Words that YAML or ROS take for something else than text."""

Values: TypeAlias = Mapping[str, Mapping[str, Value]]
"""Values by node and parameter."""


class Dumper(_SafeDumper):
    """Writes every text in quotes that any of the YAML dialects of ROS could take for something else."""


def _represent_text(dumper: Any, text: str) -> Any:
    plain = PLAIN.fullmatch(text) and text.lower() not in WORDS
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=None if plain else '"')


Dumper.add_representer(str, _represent_text)


def save(path: Path, trees: Mapping[str, ParameterTree], nodes: tuple[str, ...] = ()) -> int:
    """Write the parameters of some nodes (default: all) and give their number; raises `OSError` or `ValueError`.

    In an existing file the values that stand there are replaced in place and the others are added at the end.
    """
    values = {
        tree.node: {
            each.name: each.value
            for each in tree.parameters
            if each.value is not None and each.name not in BUILT_IN and not each.read_only
        }
        for tree in trees.values()
        if not nodes or tree.node in nodes
    }
    values = {node: found for node, found in values.items() if found}
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    _replace_file(path, patched(text, values) if text.strip() else dumped(values))
    return sum(len(found) for found in values.values())


def dumped(values: Values) -> str:
    """A parameter file with these values."""
    data = {node: {KEYWORD: _nested(found)} for node, found in values.items()}
    return yaml.dump(data, Dumper=Dumper, sort_keys=False, allow_unicode=True, default_flow_style=None)


def patched(text: str, values: Values) -> str:
    """The text of a parameter file with values replaced in place; raises `ValueError` when it is not YAML."""
    try:
        root = cast("Any", yaml.compose(text, Loader=Loader))  # pyright: ignore[reportUnknownMemberType]
    except yaml.YAMLError as error:
        raise ValueError(f"the file is not YAML, so it cannot be patched: {error}") from None
    places: dict[tuple[str, str], Any] = {}
    if isinstance(root, yaml.MappingNode):
        _locate("", root, places)
    left = {node: dict(found) for node, found in values.items()}
    edits: list[tuple[int, int, str]] = []
    for (node, name), place in places.items():
        if name in left.get(node, {}):
            value = left[node].pop(name)
            if _value_at(place) != _plain(value):
                edits.append((place.start_mark.index, _end(place), _inline(value)))
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    rest = {node: found for node, found in left.items() if found}
    return text if not rest else _extended(text, rest)


def _value_at(place: Any) -> Any:
    """What stands in the file now."""
    text: str = yaml.serialize(place)  # pyright: ignore[reportUnknownMemberType]
    return yaml.safe_load(text)


def _end(place: Any) -> int:
    """Where a value ends; the mark of a block sequence stands at the next key, that of its last element does not."""
    if isinstance(place, yaml.SequenceNode) and not place.flow_style and place.value:
        return _end(place.value[-1])
    return place.end_mark.index


def _extended(text: str, rest: Values) -> str:
    """Add what does not stand in the file yet; nodes that stand there already are rewritten by the YAML library."""
    data: Mapping[Any, Any] = yaml.load(text, Loader) or {}
    known = {("/" + str(key).strip("/")) for key in data}
    new = {node: found for node, found in rest.items() if node not in known}
    if len(new) == len(rest):
        return text.rstrip("\n") + "\n" + dumped(new)
    raise ValueError(
        "the file lacks "
        + ", ".join(f"{node}: {name}" for node, found in rest.items() if node in known for name in found)
        + "; add those lines, or save to a new file"
    )


def _locate(space: str, mapping: yaml.MappingNode, places: dict[tuple[str, str], Any]) -> None:
    for key, value in mapping.value:
        if key.value == KEYWORD and isinstance(value, yaml.MappingNode):
            _locate_parameters(space, "", value, places)
        elif isinstance(value, yaml.MappingNode):
            _locate(f"{space}/{key.value.strip('/')}", value, places)


def _locate_parameters(node: str, prefix: str, mapping: yaml.MappingNode, places: dict[tuple[str, str], Any]) -> None:
    for key, value in mapping.value:
        if isinstance(value, yaml.MappingNode):
            _locate_parameters(node, f"{prefix}{key.value}.", value, places)
        else:
            places[node, prefix + key.value] = value


def _nested(values: Mapping[str, Value]) -> dict[str, Any]:
    """Dotted names as nested maps, as `ros2 param dump` writes them."""
    root: dict[str, Any] = {}
    for name, value in sorted(values.items()):
        *path, last = name.split(".")
        at = root
        for step in path:
            below: Any = at.setdefault(step, {})
            if not isinstance(below, dict):
                at, last = root, name
                break
            at = cast("dict[str, Any]", below)
        at[last] = _plain(value)
    return root


def _plain(value: Value) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _inline(value: Value) -> str:
    """A value as it stands behind a key, on one line."""
    text = yaml.dump(_plain(value), Dumper=Dumper, default_flow_style=True, allow_unicode=True, width=10**9)
    return text.removesuffix("\n").removesuffix("\n...")


def _replace_file(path: Path, text: str) -> None:
    """Write beside the file and rename, so that a full disk or a crash never leaves half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
