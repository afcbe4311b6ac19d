"""Parse the value of `-p name:=value`: a scalar or a flat list in YAML."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from bot_console.runtime.rmw.parameter_overrides import ParameterYamlError, Slots
from bot_console.runtime.rmw.parameter_scalars import Scalar, scalar_value
from bot_console.runtime.rmw.parameter_types import word_of

_WORD = re.compile(r"(?!\.\.\.\Z)[A-Za-z0-9_./+][A-Za-z0-9_./+-]*\Z|-[A-Za-z0-9_.][A-Za-z0-9_./+-]*\Z")
_STRING_TAG = "tag:yaml.org,2002:str"


def yaml_events(source: str | bytes) -> Iterator[Any]:
    """Yield the events of a YAML text; raises `yaml.YAMLError`."""
    import yaml

    untyped: Any = yaml  # the stubs leave `parse` untyped
    try:
        yield from untyped.parse(source, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except ValueError as error:  # an incomplete character, as in an argument typed in a terminal
        raise yaml.YAMLError(str(error)) from None


class ValueWriter:
    """Writes scalars into a parameter's slots; the elements of a list must have the same type."""

    def __init__(self) -> None:
        self.in_list = False
        self._kind: str | None = None

    def start_list(self) -> None:
        """Begin a list, whose first element determines its type."""
        self.in_list = True
        self._kind = None

    def end_list(self) -> None:
        """End the list."""
        self.in_list = False

    def scalar(self, event: Any, slots: Slots) -> None:
        """Write a YAML scalar; raises `ParameterYamlError` if it is empty or does not fit its list."""
        line = event.start_mark.line + 1
        quoted = event.style in ("'", '"')
        if not quoted and not event.value:
            raise ParameterYamlError(f"No value at line {line}")
        self.put(event.value if quoted or event.tag == _STRING_TAG else scalar_value(event.value), slots, line)

    def put(self, value: Scalar, slots: Slots, line: int) -> None:
        """Write a value that is on the given line of the source."""
        kind = word_of(value)
        if not self.in_list:
            slots[kind, False] = value
        elif self._kind is None:
            self._kind = kind
            slots[kind, True] = [value]
        elif self._kind == kind:
            slots[kind, True].append(value)
        else:
            raise ParameterYamlError(
                f"Sequence should be of same type. Value type '{kind}' do not belong at line_num {line}"
            )


def read_parameter_value(text: str, slots: Slots) -> None:
    """Parse a value into a parameter's slots; raises `ParameterYamlError`."""
    writer = ValueWriter()
    if _WORD.match(text):
        # A plain word needs no YAML parser, whose import takes longer than a node's start should.
        writer.put(scalar_value(text), slots, 1)
        return
    import yaml

    try:
        for event in yaml_events(text):
            _take(event, writer, slots)
    except yaml.YAMLError:
        raise ParameterYamlError("Error parsing an event") from None


def _take(event: object, writer: ValueWriter, slots: Slots) -> None:
    import yaml

    if isinstance(event, yaml.ScalarEvent):
        writer.scalar(event, slots)
    elif isinstance(event, yaml.SequenceStartEvent):
        writer.start_list()
    elif isinstance(event, yaml.SequenceEndEvent):
        writer.end_list()
    elif isinstance(event, (yaml.AliasEvent, yaml.MappingStartEvent, yaml.MappingEndEvent)):
        raise ParameterYamlError("Unknown YAML event")
