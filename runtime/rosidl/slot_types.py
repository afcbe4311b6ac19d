"""`SLOT_TYPES` of message classes, created on first use."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.definition import Type


def nested_class(owner: Any, item: str) -> Any:
    """Return the class of a nested message, such as `geometry_msgs/Vector3`, for the message class that contains it."""
    package, _, name = item.partition("/")
    names = owner._copy_.__globals__
    return names.get(f"_{package}__{name}") or names[name]


class SlotTypes:
    """A class attribute with the types of the fields, in order."""

    def __init__(self) -> None:
        self._made: dict[Any, Sequence[Any]] = {}

    def __get__(self, message: Any, owner: Any) -> Sequence[Any]:
        if owner not in self._made:
            from bot_console.runtime.rosidl.definition import parse_type

            texts = owner._fields_and_field_types.values()
            self._made[owner] = tuple(_parser_type(parse_type(text), owner) for text in texts)
        return self._made[owner]


def _parser_type(kind: Type, owner: object) -> Any:
    from rosidl_parser.definition import Array, BoundedSequence, UnboundedSequence

    item = _item(kind, owner)
    if kind.size:
        return Array(item, kind.size)
    if kind.sequence:
        return BoundedSequence(item, kind.bound) if kind.bound else UnboundedSequence(item)
    return item


def _item(kind: Type, owner: object) -> Any:
    from rosidl_parser import definition

    if not kind.primitive:
        cls = nested_class(owner, kind.item)
        return definition.NamespacedType(cls.__module__.split(".")[:2], cls.__name__)
    if kind.item == "string":
        return definition.BoundedString(kind.limit) if kind.limit else definition.UnboundedString()
    if kind.item == "wstring":
        return definition.BoundedWString(kind.limit) if kind.limit else definition.UnboundedWString()
    return definition.BasicType(kind.item)
