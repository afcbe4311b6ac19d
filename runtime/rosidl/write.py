"""Writes interfaces in the notation of `.msg`, `.srv` and `.action` files."""

from __future__ import annotations

import ast
from typing import Any, cast

from bot_console.runtime.rosidl.definition import WRITTEN, Constant, Definition, Field, Interface, Type


def to_text(interface: Interface) -> str:
    """Return the text of a definition file, with its parts separated by `---`."""
    return "---\n".join(_part(each, interface.package) for each in interface.parts)


def _part(definition: Definition, package: str) -> str:
    lines = [_constant(each) for each in definition.constants]
    lines += [_field(each, package) for each in definition.fields]
    return "".join(line + "\n" for line in lines)


def _constant(constant: Constant) -> str:
    return f"{constant.type} {constant.name}={_value(_read(constant.value))}"


def _field(field: Field, package: str) -> str:
    text = f"{_type(field.type, package)} {field.name}"
    return text if field.default is None else f"{text} {_value(_read(field.default))}"


def _read(literal: str) -> Any:
    """Return the value of a Python literal; includes `float('inf')` and the like, which the parser produces."""
    inner = literal.removeprefix("float('").removesuffix("')")
    return float(inner) if inner != literal else ast.literal_eval(literal)


def _type(kind: Type, package: str) -> str:
    item = WRITTEN[kind.item] if kind.primitive else kind.item.removeprefix(f"{package}/")
    item += f"<={kind.limit}" if kind.limit else ""
    if kind.sequence:
        return f"{item}[<={kind.bound}]" if kind.bound else f"{item}[]"
    return f"{item}[{kind.size}]" if kind.size else item


def _value(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, bytes):
        return str(value[0])
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, cast("list[object]", value))) + "]"
    return repr(value)
