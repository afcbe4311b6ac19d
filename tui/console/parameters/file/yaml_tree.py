"""Parses YAML into a tree with positions, so that single values can be replaced and everything else stays."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, TypeAlias, Union

import yaml

_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_yaml: Any = yaml
_TEXT_TAG = "tag:yaml.org,2002:str"


@dataclass
class Scalar:
    """A scalar as written; `start` and `end` are positions in the text."""

    text: str
    quoted: bool
    start: int
    end: int
    line: int

    @property
    def missing(self) -> bool:
        """Whether nothing is written there, as after `key:`."""
        return not self.text and not self.quoted


@dataclass
class Sequence:
    """A list, in brackets (`flow`) or with one element per line."""

    flow: bool
    start: int
    line: int
    column: int
    end: int = 0
    elements: list[YamlTree] = field(default_factory=list["YamlTree"])


@dataclass
class Mapping:
    """A mapping, in braces (`flow`) or with one key per line; `column` is the column of the keys."""

    flow: bool
    start: int
    line: int
    column: int
    end: int = 0
    entries: list[tuple[Scalar, YamlTree]] = field(default_factory=list["tuple[Scalar, YamlTree]"])

    def get(self, key: str) -> YamlTree | None:
        """The value of a key; None if the mapping lacks it."""
        return next((value for name, value in self.entries if name.text == key), None)


YamlTree: TypeAlias = Union[Scalar, Sequence, Mapping]  # noqa: UP007 -- evaluated on Python 3.10, before the classes


def read_tree(text: str) -> YamlTree | None:
    """Parse a text; returns None if it has no content.

    Raises `ValueError` with the line if the text is not YAML, or contains an alias, a key that is not a scalar, or more
    than one document: none of these is valid in a ROS parameter file.
    """
    try:
        return _Builder(_yaml.parse(text, Loader=_Loader)).document()
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}: " if mark else ""
        problem = getattr(error, "problem", None) or getattr(error, "reason", None) or error
        raise ValueError(f"{where}not YAML: {problem}") from None
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


class _Builder:
    """Builds the tree from the parser's events."""

    def __init__(self, events: Iterator[Any]) -> None:
        self._events = events

    def document(self) -> YamlTree | None:
        root: YamlTree | None = None
        documents = 0
        for event in self._events:
            if isinstance(event, yaml.DocumentStartEvent):
                documents += 1
                if documents > 1:
                    raise ValueError(f"line {event.start_mark.line + 1}: a second document begins")
                root = self._tree(next(self._events))
        return None if isinstance(root, Scalar) and root.missing else root

    def _tree(self, event: Any) -> YamlTree:
        start, line = event.start_mark.index, event.start_mark.line + 1
        if isinstance(event, yaml.ScalarEvent):
            quoted = event.style in ("'", '"') or event.tag == _TEXT_TAG
            return Scalar(event.value, quoted, start, event.end_mark.index, line)
        if isinstance(event, yaml.SequenceStartEvent):
            sequence = Sequence(bool(event.flow_style), start, line, event.start_mark.column)
            for below in self._events:
                if isinstance(below, yaml.SequenceEndEvent):
                    sequence.end = below.end_mark.index
                    break
                sequence.elements.append(self._tree(below))
            return sequence
        if isinstance(event, yaml.MappingStartEvent):
            return self._mapping(Mapping(bool(event.flow_style), start, line, event.start_mark.column))
        raise ValueError(f"line {line}: there is an alias (*{event.anchor}), which ROS does not read")

    def _mapping(self, mapping: Mapping) -> Mapping:
        keys: set[str] = set()
        for event in self._events:
            if isinstance(event, yaml.MappingEndEvent):
                mapping.end = event.end_mark.index
                break
            key = self._tree(event)
            if not isinstance(key, Scalar) or not key.text:
                raise ValueError(f"line {key.line}: a key has to be a name")
            if key.text in keys:
                raise ValueError(f"line {key.line}: '{key.text}' appears for the second time")
            keys.add(key.text)
            mapping.entries.append((key, self._tree(next(self._events))))
        return mapping
