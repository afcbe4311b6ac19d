"""Writes values into the text of a parameter file; everything else in it, above all comments, stays as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias, cast

from bot_console.tui.console.model import Value, same
from bot_console.tui.console.parameters.file import yaml_tree
from bot_console.tui.console.parameters.file.node_keys import matches_node
from bot_console.tui.console.parameters.file.text import KEYWORD, Section, block_text, inline_text, sections, value_at
from bot_console.tui.console.parameters.file.yaml_tree import Scalar, Sequence, YamlTree, read_tree

Values: TypeAlias = Mapping[str, Mapping[str, Value]]
"""Values by node (fully qualified name) and parameter."""


def new_text(values: Values) -> str:
    """A new parameter file with these values."""
    return "".join(block_text(node, {KEYWORD: nested(found)}) for node, found in values.items())


def patched(text: str, values: Values) -> str:
    """Put values into the text of a parameter file: existing ones are replaced in place, the others are added.

    Raises `ValueError` if the text is not a parameter file, or if the result would mean something else.
    """
    before = sections(text)
    newline = "\r\n" if "\r\n" in text else "\n"
    edits = [*_replacements(text, before, values), *_additions(text, before, values)]
    # From the end, so that positions stay valid; of two edits at one position the later one first, since its text comes
    # after the other's.
    for edit in sorted(reversed(edits), key=lambda each: each.start, reverse=True):
        text = text[: edit.start] + edit.text.replace("\n", newline) + text[edit.end :]
    if not before:
        gap = "" if not text or text.endswith("\n") else newline
        text += gap + new_text(values).replace("\n", newline)
    compare(before, sections(text), values)
    return text


@dataclass(frozen=True)
class _Edit:
    start: int
    end: int
    text: str


def _sections_of(found: list[Section], node: str) -> list[Section]:
    """The sections whose key is exactly this node; the one that takes effect comes first."""
    return [each for each in reversed(found) if each.key == node]


def _replacements(text: str, found: list[Section], values: Values) -> Iterator[_Edit]:
    for node, wanted in values.items():
        for name, value in wanted.items():
            place = next((each.places[name] for each in _sections_of(found, node) if name in each.places), None)
            if place is not None and not (isinstance(place, Scalar) and place.missing):
                if not same(value_at(name, place), value):
                    yield from _value_edits(text, place, value)
            elif place is not None:
                yield _Edit(place.start, place.start, " " + inline_text(value))


def _value_edits(text: str, place: Scalar | Sequence, value: Value) -> Iterator[_Edit]:
    """Replace a value; if a list has one element per line, element by element, since comments may follow them."""
    if isinstance(place, Sequence) and not place.flow and place.elements and isinstance(value, tuple) and value:
        for element, new in zip(place.elements, value, strict=False):
            assert isinstance(element, Scalar)
            if not same(value_at("", element), new):
                yield _Edit(element.start, _end(text, element), inline_text(new))
        yield from _length_edits(text, place, value)
    else:
        # The dashes of a list may be as far to the left as its key; a value has to be indented further.
        block = isinstance(place, Sequence) and not place.flow
        yield _Edit(place.start, _end(text, place), "  " * block + inline_text(value))


def _length_edits(text: str, place: Sequence, value: tuple[Any, ...]) -> Iterator[_Edit]:
    """Add lines for additional elements, or remove the lines of surplus ones."""
    ends = [_line_end(text, _end(text, each)) for each in place.elements]
    if len(value) < len(ends):
        yield _Edit(ends[len(value) - 1], ends[-1], "")
    elif len(value) > len(ends):
        lines = (f"\n{' ' * place.column}- {inline_text(each)}" for each in value[len(ends) :])
        yield _Edit(ends[-1], ends[-1], "".join(lines))


def _additions(text: str, found: list[Section], values: Values) -> Iterator[_Edit]:
    """The parameters missing from the file's nodes, and the nodes missing from the file."""
    root = read_tree(text)
    missing: dict[str, Any] = {}
    for node, wanted in values.items():
        own = _sections_of(found, node)
        new = {name: value for name, value in wanted.items() if not any(name in each.places for each in own)}
        if not own:
            missing[node] = {KEYWORD: nested(wanted)}
        elif new:
            yield _addition(text, own[0].mapping, new)
    if missing and isinstance(root, yaml_tree.Mapping):
        yield _addition(text, root, missing)


def _addition(text: str, mapping: yaml_tree.Mapping, new: Mapping[str, Any]) -> _Edit:
    if mapping.flow:
        inside = ", ".join(f"{inline_text(key)}: {inline_text(value)}" for key, value in new.items())
        at = mapping.end - 1
        return _Edit(at, at, f", {inside}" if mapping.entries else inside)
    lines = "".join(block_text(key, value) for key, value in new.items())
    at = _line_end(text, _end(text, mapping))
    indent = " " * mapping.column
    return _Edit(at, at, "".join(f"\n{indent}{line}" for line in lines.splitlines()))


def _end(text: str, tree: YamlTree) -> int:
    """The end of an item; the YAML parser ends a block only where the next item begins."""
    if isinstance(tree, yaml_tree.Mapping) and not tree.flow and tree.entries:
        key, value = tree.entries[-1]
        return max(key.end, _end(text, value))
    if isinstance(tree, Sequence) and not tree.flow and tree.elements:
        return _end(text, tree.elements[-1])
    return tree.start + len(text[tree.start : tree.end].rstrip())


def _line_end(text: str, at: int) -> int:
    found = re.compile(r"\r?\n|\r|\Z").search(text, at)
    return found.start() if found else len(text)


def nested(values: Mapping[str, Value]) -> dict[str, Any]:
    """Convert dotted names to nested maps, as `ros2 param dump` does."""
    root: dict[str, Any] = {}
    for name, value in sorted(values.items()):
        *path, last = name.split(".")
        at: dict[str, Any] | None = root
        for step in path if all((*path, last)) else ():
            below: Any = at.setdefault(step, {}) if at is not None else None
            at = cast("dict[str, Any]", below) if isinstance(below, dict) else None
        if at is None or at is root:
            at, last = root, name
        at[last] = list(value) if isinstance(value, tuple) else value
    return root


def compare(before: list[Section], after: list[Section], values: Values) -> None:
    """Raise `ValueError` if a node would not get its values from the new text, or if another value has changed."""
    merged = _by_key(after)
    for node, wanted in values.items():
        given = _values_for(merged, node)
        for name, value in wanted.items():
            if name not in given:
                raise ValueError(f"{node} would not get {name}")
            key, place = given[name]
            if not same(value_at(name, place), value):
                raise ValueError(f"{node} would get the {name} that is below '{key}'")
    others = {(each.key, name): place for each in before for name, place in each.places.items()}
    for section in after:
        for name, place in section.places.items():
            old = others.get((section.key, name))
            value = value_at(name, place)
            if old and name not in values.get(section.key, ()) and not same(value_at(name, old), value):
                raise ValueError(f"line {old.line}: {name} would change, too")


_Places = dict[str, tuple[str, Scalar | Sequence]]
"""The key and the position of each value, by parameter."""


def _by_key(found: list[Section]) -> dict[str, _Places]:
    """The parameters below each key of a file, in which a key may occur more than once."""
    merged: dict[str, _Places] = {}
    for section in found:
        merged.setdefault(section.key, {}).update({name: (section.key, at) for name, at in section.places.items()})
    return merged


def _values_for(merged: dict[str, _Places], node: str) -> _Places:
    """The values that a file gives to a node: the key and position of each. As in ROS, the later of two keys wins."""
    given: _Places = {}
    for key, places in merged.items():
        if matches_node(key, node):
            given.update(places)
    return given
