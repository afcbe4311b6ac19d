"""Messages as YAML, CSV and dictionaries, in the form that `ros2 topic echo` prints."""

from __future__ import annotations

import sys
from array import array
from collections import OrderedDict
from collections.abc import Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from rosidl_parser.definition import AbstractString, AbstractWString, Array, BasicType, BoundedSequence
from rosidl_runtime_py.block_yaml import block_yaml

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message


class Shortening(NamedTuple):
    """What is omitted from the output: elements and characters beyond `length`, arrays, strings."""

    length: int | None = None
    no_arrays: bool = False
    no_strings: bool = False

    def cuts(self, value: Any) -> bool:
        """Whether a value is longer than what is shown."""
        return self.length is not None and len(value) > self.length


def message_to_yaml(
    msg: Message,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """Return a message as YAML; sequences and strings are cut at `truncate_length` and followed by `...`."""
    values = message_to_ordereddict(msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str)
    return ordereddict_to_yaml(values, flow_style=flow_style)


def ordereddict_to_yaml(values: OrderedDict[str, Any], *, flow_style: bool = False) -> str:
    """Return fields as YAML in their order; if `flow_style`, with sequences in brackets."""
    quick = None if flow_style else block_yaml(values)
    if quick is not None:
        return quick
    import yaml

    return yaml.dump(values, Dumper=_dumper(), allow_unicode=True, width=sys.maxsize, default_flow_style=flow_style)


@cache
def _dumper() -> Any:
    import yaml

    class Dumper(yaml.Dumper):
        """Writes fields in their original order."""

    def in_order(dumper: Any, data: OrderedDict[str, Any]) -> Any:
        rows = [(dumper.represent_data(key), dumper.represent_data(value)) for key, value in data.items()]
        return yaml.MappingNode("tag:yaml.org,2002:map", rows)

    Dumper.add_representer(OrderedDict, in_order)
    return Dumper


def message_to_csv(
    msg: Message, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> str:
    """Return the values of a message separated by commas."""
    return _csv(msg, Shortening(truncate_length, no_arr, no_str))


def _csv(msg: Message, short: Shortening) -> str:
    types = zip(msg.get_fields_and_field_types(), msg.SLOT_TYPES, strict=False)
    return _joined(_csv_value(getattr(msg, name), kind, short) for name, kind in types)


def _joined(texts: Iterable[str]) -> str:
    """Join texts with commas; as upstream, empty ones at the beginning leave no comma."""
    joined = ""
    for each in texts:
        joined += f",{each}" if joined else each
    return joined


def _csv_value(value: Any, kind: Any, short: Shortening) -> str:
    if _is_array(value):
        if short.no_arrays and kind is not None:
            return _array_words(value, kind)
        shown = value[: short.length] if short.cuts(value) else value
        items = [_csv_value(each, None, short) for each in shown]
        return _joined([*items, "..."] if short.cuts(value) else items)
    if isinstance(value, str) and short.no_strings:
        return _string_words(value)
    if isinstance(value, str) and short.cuts(value):
        return value[: short.length] + "..."
    if isinstance(value, bytes) and short.cuts(value):
        return str(value[: short.length] + b"...")
    if isinstance(value, (str, bytes, bool, int, float)) or _is_numpy_number(value):
        return str(value)
    return _csv(value, short)


def message_to_ordereddict(
    msg: Message, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> OrderedDict[str, Any]:
    """Return the fields of a message in order; nested messages are dictionaries, too."""
    return _ordered(msg, Shortening(truncate_length, no_arr, no_str))


def _ordered(msg: Message, short: Shortening) -> OrderedDict[str, Any]:
    types = zip(msg.get_fields_and_field_types(), msg.SLOT_TYPES, strict=False)
    return OrderedDict((name, _plain(getattr(msg, name, None), kind, short)) for name, kind in types)


def _plain(value: Any, kind: Any, short: Shortening) -> Any:
    if isinstance(value, bytes):
        text = value.decode("latin-1")
        return text[: short.length] + "..." if short.cuts(text) else text
    if isinstance(value, str):
        if short.no_strings:
            return _string_words(value)
        return value[: short.length] + "..." if short.cuts(value) else value
    if _is_array(value):
        return _plain_array(value, kind, short)
    if isinstance(value, Mapping):
        return {_plain(key, None, Shortening()): _plain(each, None, short) for key, each in value.items()}
    if _is_numpy_number(value):
        return value.item()
    return value if isinstance(value, (bool, int, float)) else _ordered(value, short)


def _plain_array(value: Any, kind: Any, short: Shortening) -> Any:
    if short.no_arrays and kind is not None:
        return _array_words(value, kind)
    shown = value[: short.length] if short.cuts(value) else value
    items = [_plain(each, None, short) for each in shown]
    items += ["..."] if short.cuts(value) else []
    return tuple(items) if isinstance(value, tuple) else items


def _is_array(value: object) -> bool:
    return isinstance(value, (list, tuple, array)) or type(value).__name__ == "ndarray"


def _is_numpy_number(value: object) -> bool:
    return type(value).__module__ == "numpy" and hasattr(value, "item")


def _string_words(value: str) -> str:
    return f"<string length: <{len(value)}>>"


def _array_words(value: Any, kind: Any) -> str:
    item = _item_words(kind.value_type)
    if isinstance(kind, Array):
        return f"<array type: {item}[{kind.size}]>"
    bound = f"[{kind.maximum_size}]" if isinstance(kind, BoundedSequence) else ""
    return f"<sequence type: {item}{bound}, length: {len(value)}>"


def _item_words(kind: Any) -> str:
    if isinstance(kind, BasicType):
        return kind.typename
    if isinstance(kind, AbstractString):
        return "string"
    return "wstring" if isinstance(kind, AbstractWString) else "/".join(kind.namespaced_name())


def get_message_slot_types(msg: Message) -> OrderedDict[str, Any]:
    """Return the types of a message's fields by name, as defined in `rosidl_parser.definition`."""
    return OrderedDict(zip((slot[1:] for slot in msg.__slots__), msg.SLOT_TYPES, strict=False))
