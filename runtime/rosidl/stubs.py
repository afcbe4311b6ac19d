"""Type stubs of interfaces for editors and type checkers: every field with its type, range and comment."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from keyword import iskeyword

from bot_console.runtime.rosidl.comments import Comments, comments
from bot_console.runtime.rosidl.definition import (
    DTYPES,
    PRIMITIVES,
    TYPECODES,
    WRITTEN,
    Definition,
    Field,
    Interface,
    Type,
)
from bot_console.runtime.rosidl.emit import SCALARS
from bot_console.runtime.rosidl.emit_copy import LIMITS
from bot_console.runtime.rosidl.emit_holder import SERVICE_PARTS
from bot_console.runtime.rosidl.names import module_name
from bot_console.runtime.rosidl.parse import parse
from bot_console.runtime.rosidl.parts import companions

HEAD = '''\
"""{package}/{kind}/{name}"""
import builtins as _b
from array import array as _array
from collections.abc import Iterable as _Iterable, Sequence as _Sequence
from typing import Any as _Any

import numpy as _numpy
from numpy.typing import NDArray as _NDArray

from bot_console.runtime.rosidl.message import Message as _Message, ServiceType as _ServiceType
'''
"""Imported under names that no field can have: within its class, a field named `list` would hide the type."""
NO_COMMENTS = Comments("", {})


def package_stubs(package: str, texts: Mapping[tuple[str, str], str]) -> dict[str, str]:
    """Return the stub files of a package by their paths below its folder.

    `texts` has the text of each definition by kind (`msg`, `srv`, `action`) and name. Raises `DefinitionError`.
    """
    files = {"__init__.pyi": ""}
    exported: dict[str, list[str]] = {}
    for (kind, name), text in sorted(texts.items()):
        interface = parse(text, package, kind, name)
        module = module_name(name)
        files[f"{kind}/{module}.pyi"] = "\n".join(_module(interface, text)) + "\n"
        classes = [each.name for each in interface.parts]
        if kind != "msg":
            classes.append(name)
        exported.setdefault(kind, []).extend(f"from .{module} import {each} as {each}" for each in sorted(classes))
    return files | {f"{kind}/__init__.pyi": "\n".join(rows) + "\n" for kind, rows in exported.items()}


def _module(interface: Interface, text: str) -> Iterator[str]:
    definitions = [*interface.parts, *companions(interface)]
    yield HEAD.format(package=interface.package, kind=interface.kind, name=interface.name)
    names: dict[str, str] = {}
    here = {f"{interface.package}/{each.name}": each.name for each in definitions}
    for item in sorted({field.type.item for each in definitions for field in each.fields if not field.type.primitive}):
        package, _, name = item.partition("/")
        names[item] = here.get(item, f"_{package}__{name}")
        if item not in here:
            yield f"from {package}.msg.{module_name(name)} import {name} as {names[item]}"
    described = [*comments(text), *[NO_COMMENTS] * len(definitions)]
    for definition, of_it in zip(definitions, described, strict=False):
        yield from _message(definition, of_it, names)
    if interface.kind == "srv":
        yield from _holder(interface.name, described[0].whole, SERVICE_PARTS)
    if interface.kind == "action":
        for each in ("SendGoal", "GetResult"):
            yield from _holder(f"{interface.name}_{each}", "", SERVICE_PARTS)
        yield from _holder(interface.name, described[0].whole, ("Goal", "Result", "Feedback"))
        yield "    class Impl:"
        yield "        from action_msgs.msg._goal_status_array import GoalStatusArray as GoalStatusMessage"
        yield "        from action_msgs.srv._cancel_goal import CancelGoal as CancelGoalService"
        for part, name in (("SendGoalService", "SendGoal"), ("GetResultService", "GetResult")):
            yield f"        {part} = {interface.name}_{name}"
        yield f"        FeedbackMessage = {interface.name}_FeedbackMessage"


def _holder(name: str, text: str, parts: Sequence[str]) -> Iterator[str]:
    yield from (
        "",
        f"class {name}(metaclass=_ServiceType):",
        *_docstring_lines(text or f"{name}: {', '.join(parts)}.", "    "),
    )
    yield from (f"    {part} = {name}_{part}" for part in parts)


def _message(definition: Definition, of_it: Comments, names: Mapping[str, str]) -> Iterator[str]:
    definition = definition._replace(fields=[each for each in definition.fields if not iskeyword(each.name)])
    fields = [f"{each.name} ({_type_and_range(each)})" for each in definition.fields]
    listed = "Fields: " + ", ".join(fields) if fields else "No fields."
    yield from ("", f"class {definition.name}(_Message):")
    yield from _docstring_lines(f"{of_it.whole}\n\n{listed}".strip(), "    ")
    for constant in definition.constants:
        kind = SCALARS.get(PRIMITIVES[constant.type], "int")
        yield f"    {constant.name}: _b.{kind} = {constant.value}"
        if text := of_it.members.get(constant.name):
            yield from _docstring_lines(text, "    ")
    for field in definition.fields:
        if field.default is not None:
            yield f"    {field.name.upper()}__DEFAULT: _Any"
    arguments = "".join(
        f"{each.name}: {_assignable_annotation(each.type, names)} = ..., " for each in definition.fields
    )
    yield f"    def __init__(self, *, {arguments}check_fields: _b.bool | None = None) -> None: ..."
    for field in definition.fields:
        text = "\n\n".join(filter(None, (of_it.members.get(field.name, ""), _type_and_range(field))))
        yield "    @_b.property"
        yield f"    def {field.name}(self) -> {_value_annotation(field.type, names)}:"
        yield from _docstring_lines(text, "        ")
        yield f"    @{field.name}.setter"
        yield f"    def {field.name}(self, value: {_assignable_annotation(field.type, names)}) -> None: ..."


def _docstring_lines(text: str, indent: str) -> Sequence[str]:
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    text = f"{text} " if text.endswith('"') else text
    first, *rest = text.splitlines() or [""]
    lines = [f'{indent}"""{first}', *(f"{indent}{each}" if each else "" for each in rest)]
    return [*lines[:-1], f'{lines[-1]}"""']


def _type_and_range(field: Field) -> str:
    """Return the type of a field with the range of its values, such as `uint8, 0 to 255`."""
    kind = field.type
    item = WRITTEN[kind.item] if kind.primitive else kind.item
    item += f", at most {kind.limit} characters" if kind.limit else ""
    if kind.item in LIMITS:
        low, high = LIMITS[kind.item]
        item = f"{item}, {low} to {high}"
    if kind.sequence:
        item = f"sequence of {item}" + (f", at most {kind.bound} elements" if kind.bound else "")
    elif kind.size:
        item = f"array of {kind.size} {item}"
    return f"{item}, default {field.default}" if field.default is not None else item


def _item(kind: Type, names: Mapping[str, str]) -> str:
    return f"_b.{SCALARS.get(kind.item, 'int')}" if kind.primitive else names[kind.item]


def _value_annotation(kind: Type, names: Mapping[str, str]) -> str:
    """Return the type annotation of a field's value."""
    item = _item(kind, names)
    if kind.size and kind.item in DTYPES:
        return f"_NDArray[_numpy.{DTYPES[kind.item]}]"
    if kind.sequence and kind.item in TYPECODES:
        return f"_array[{item}]"
    return f"_b.list[{item}]" if kind.sequence or kind.size else item


def _assignable_annotation(kind: Type, names: Mapping[str, str]) -> str:
    """Return the type annotation of values that can be assigned to a field."""
    item = _item(kind, names)
    if not (kind.sequence or kind.size):
        return item
    return f"_Iterable[{item}]" if kind.item in TYPECODES else f"_Sequence[{item}]"
