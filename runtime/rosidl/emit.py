"""Generates the Python modules of an interface."""

from __future__ import annotations

from collections.abc import Iterator

from bot_console.runtime.rosidl.definition import DTYPES, INTEGERS, TYPECODES, Definition, Field, Interface, Type
from bot_console.runtime.rosidl.emit_copy import copy_lines
from bot_console.runtime.rosidl.emit_holder import action, service, service_module
from bot_console.runtime.rosidl.names import module_name
from bot_console.runtime.rosidl.parts import companions

HEAD = '''\
"""Interface {package}/{kind}/{name}; generated, do not edit."""
# ruff: noqa
# pyright: reportPrivateUsage=false, reportUnusedImport=false
from __future__ import annotations

from array import array as _array
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl.conversion import (
    FieldTypeError as _FieldTypeError, to_bool as _to_bool, to_fixed as _to_fixed, to_float as _to_float,
    to_int as _to_int, to_list as _to_list, to_message as _to_message, to_messages as _to_messages,
    to_ndarray as _to_ndarray, to_octet as _to_octet, to_str as _to_str, too_long as _too_long, zeros as _zeros,
)
from bot_console.runtime.rosidl.message import Message as _Message, ServiceType as _ServiceType
from bot_console.runtime.rosidl.message import checks_asked_for as _checks_asked_for, read_checks_again as _read_again
'''
SCALARS = {"boolean": "bool", "octet": "bytes", "float": "float", "double": "float", "string": "str", "wstring": "str"}
ZEROS = {"boolean": "False", "octet": "b'\\x00'", "float": "0.0", "double": "0.0", "string": "''", "wstring": "''"}


PARTS_SUFFIX = "__parts"
"""Suffix of the module that contains a service's request, response and event."""


def modules(interface: Interface) -> dict[str, str]:
    """Return sources by module name: one module, or two for a service, of which often only the name is needed."""
    file = module_name(interface.name)
    if interface.kind != "srv":
        return {file: _module(interface)}
    return {file: service_module(interface, file + PARTS_SUFFIX), file + PARTS_SUFFIX: _module(interface)}


def _module(interface: Interface) -> str:
    definitions = [*interface.parts, *companions(interface)]
    here = {each.name for each in definitions}
    lines = [HEAD.format(package=interface.package, kind=interface.kind, name=interface.name)]
    nested = sorted({field.type.item for each in definitions for field in each.fields if not field.type.primitive})
    known: dict[str, str] = {}
    for item in nested:
        package, _, name = item.partition("/")
        known[item] = name if package == interface.package and name in here else f"_{package}__{name}"
        if known[item] != name:
            lines.append(f"from {package}.msg.{module_name(name)} import {name} as {known[item]}")
    lines.append("\n_new = object.__new__\n_MISSING: Any = object()\n_read_again()\n")
    shown = f"{interface.package}.srv.{module_name(interface.name)}" if interface.kind == "srv" else ""
    for each in definitions:
        lines += ["", *_message(each, known, shown)]
    if interface.kind == "action":
        lines += [*service(f"{interface.name}_SendGoal"), *service(f"{interface.name}_GetResult")]
        lines += action(interface.name)
    return "\n".join(lines) + "\n"


def _message(definition: Definition, known: dict[str, str], shown: str) -> Iterator[str]:
    name = definition.name
    yield f"class {name}(_Message):"
    yield f'    """Message class \'{name}\'."""'
    yield ""
    if shown:
        yield f"    __module__ = {shown!r}"
    slots = [f"_{each.name}" for each in definition.fields]
    yield f"    __slots__ = {[*slots, '_check_fields']!r}"
    types = {each.name: each.type.text for each in definition.fields}
    yield f"    _fields_and_field_types = {types!r}"
    for constant in definition.constants:
        yield f"    {constant.name} = {constant.value}"
    for field in definition.fields:
        if field.default is not None:
            yield f"    {field.name.upper()}__DEFAULT = {field.default}"
    yield ""
    yield from ("    " + line for line in _constructor(definition, known))
    yield ""
    yield f"    def _copy_(self) -> {name}:"
    yield from ("        " + line for line in copy_lines(definition, known))
    for field in definition.fields:
        yield ""
        yield from ("    " + line for line in _property(field, known))
    yield ""


def _constructor(definition: Definition, known: dict[str, str]) -> Iterator[str]:
    arguments: list[str] = []
    for field in definition.fields:
        simple = _default(field) if _is_plain(field.type) else "_MISSING"
        arguments.append(f"{field.name}: {_assignable_annotation(field.type, known)} = {simple}")
    yield "def __init__("
    yield (
        "    self, *, " + "".join(each + ", " for each in arguments) + "check_fields: bool | None = None, **_other: Any"
    )
    yield ") -> None:"
    yield "    self._check_fields = _checks = _checks_asked_for() if check_fields is None else check_fields"
    yield "    if _other:"
    yield "        self._unknown(_other)"
    for field in definition.fields:
        yield from ("    " + line for line in _initial(field, known))


def _is_plain(kind: Type) -> bool:
    return kind.primitive and not kind.sequence and not kind.size


def _initial(field: Field, known: dict[str, str]) -> Iterator[str]:
    name = field.name
    if _is_plain(field.type):
        yield "if _checks:"
        yield f"    self._check('{name}', {name})"
        yield f"self._{name} = {name}"
        return
    yield f"if {name} is _MISSING:"
    yield f"    self._{name} = {_default(field, known)}"
    yield "else:"
    yield f"    self.{name} = {_conversion(field.type, name)}"
    if field.type.size and field.type.item in DTYPES:
        yield f"    assert self._{name}.shape == ({field.type.size},)"


def _conversion(kind: Type, value: str) -> str:
    """Return the expression with which a constructor or setter converts a value; numeric arrays are always copied."""
    if kind.size and kind.item in DTYPES:
        return f"_to_ndarray('{DTYPES[kind.item]}', {value})"
    return f"_array('{TYPECODES[kind.item]}', {value})" if kind.sequence and kind.item in TYPECODES else value


def _default(field: Field, known: dict[str, str] | None = None) -> str:
    kind = field.type
    if field.default is not None and not (kind.sequence or kind.size):
        return field.default
    if kind.sequence or kind.size:
        return _many_default(field, known or {})
    if not kind.primitive:
        return f"{(known or {})[kind.item]}()"
    return "0" if kind.item in INTEGERS else ZEROS[kind.item]


def _many_default(field: Field, known: dict[str, str]) -> str:
    kind, text = field.type, field.default
    if kind.size and kind.item in DTYPES:
        return f"_to_ndarray('{DTYPES[kind.item]}', {text})" if text else f"_zeros('{DTYPES[kind.item]}', {kind.size})"
    if kind.item in TYPECODES:
        return f"_array('{TYPECODES[kind.item]}', {text})" if text else f"_array('{TYPECODES[kind.item]}')"
    if text:
        return text
    if not kind.size:
        return "[]"
    one = f"{known[kind.item]}()" if not kind.primitive else ZEROS[kind.item]
    return f"[{one} for _ in range({kind.size})]"


def _value_annotation(kind: Type, known: dict[str, str]) -> str:
    """Return the type annotation of a field's value."""
    if kind.size and kind.item in DTYPES:
        return "Any"
    item = _item(kind, known)
    if kind.item in TYPECODES and kind.sequence:
        return f"_array[{item}]"
    return f"list[{item}]" if kind.sequence or kind.size else item


def _assignable_annotation(kind: Type, known: dict[str, str]) -> str:
    """Return the type annotation of values that can be assigned to a field."""
    if kind.size and kind.item in DTYPES:
        return "Any"
    item = _item(kind, known)
    if kind.item in TYPECODES and kind.sequence:
        return f"Sequence[{item}] | _array[{item}]"
    return f"Sequence[{item}]" if kind.sequence or kind.size else item


def _item(kind: Type, known: dict[str, str]) -> str:
    return known[kind.item] if not kind.primitive else SCALARS.get(kind.item, "int")


def _property(field: Field, known: dict[str, str]) -> Iterator[str]:
    name, kind = field.name, field.type
    yield "@property"
    yield f"def {name}(self) -> {_value_annotation(kind, known)}:"
    yield f'    """Message field \'{name}\'."""'
    yield f"    return self._{name}"
    yield ""
    yield f"@{name}.setter"
    yield f"def {name}(self, value: {_assignable_annotation(kind, known)}) -> None:"
    converted = _conversion(kind, "value")
    yield "    if self._check_fields:"
    if converted == "value":
        yield f"        self._check('{name}', value)"
    else:
        yield f"        if self._check('{name}', value):"
        yield f"            self._{name} = value"
        yield "            return"
    yield f"    self._{name} = {converted}  # type: ignore[assignment]"
