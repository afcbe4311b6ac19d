"""Generates the copy function of a message class: the effect of a CDR round trip, in plain Python.

If every field holds exactly the type of its definition, a copy is a few slot assignments; any other value goes to
`conversion`, which either converts it as the wire would or raises an error with the field's name.
"""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.runtime.rosidl.definition import DTYPES, INTEGERS, TYPECODES, Definition, Field

LIMITS = {
    name: (
        (0, 2 ** int(name[4:]) - 1) if name[0] == "u" else (-(2 ** (int(name[3:]) - 1)), 2 ** (int(name[3:]) - 1) - 1)
    )
    for name in INTEGERS
}
"""The smallest and the largest value of each integer type."""
EXACT = {"boolean": "bool", "double": "float", "string": "str", "wstring": "str"}


def copy_lines(definition: Definition, module_of: dict[str, str]) -> list[str]:
    """Return the body of `_copy_(self)`; `module_of` maps nested classes to their names in the module."""
    lines = [f"new = _new({definition.name})", "new._check_fields = False"]
    singles = [each for each in definition.fields if each.type.text == "float"]
    nested = [each for each in definition.fields if not (each.type.primitive or each.type.sequence or each.type.size)]
    for field in definition.fields:
        if field not in singles and field not in nested:
            lines += _many(field, module_of) if field.type.sequence or field.type.size else _single(field)
    return lines + _nested(nested, module_of) + _singles(singles) + ["return new"]


def _nested(fields: Sequence[Field], module_of: dict[str, str]) -> list[str]:
    """Copy all single nested messages; the slow path locates an error inside one, as it knows the path."""
    if not fields:
        return []
    lines = ["try:"]
    for field in fields:
        name, cls = field.name, module_of[field.type.item]
        lines += [
            f"    value = self._{name}",
            f"    new._{name} = value._copy_() if value.__class__ is {cls} else _to_message(self, '{name}', {cls})",
        ]
    lines += ["except _FieldTypeError:"]
    lines += [f"    _to_message(self, '{each.name}', {module_of[each.type.item]})" for each in fields]
    return [*lines, "    raise"]


def _singles(fields: Sequence[Field]) -> list[str]:
    """Copy all float32 fields at once: one array rounds them."""
    if not fields:
        return []
    values = ", ".join(f"self._{each.name}" for each in fields)
    targets = ", ".join(f"new._{each.name}" for each in fields)
    checks = " and ".join(f"self._{each.name}.__class__ is float" for each in fields)
    lines = [f"if not ({checks}):"]
    lines += [f"    _to_float(self, '{each.name}')" for each in fields]
    comma = "," if len(fields) == 1 else ""
    return [*lines, f"{targets}{comma} = _array('f', ({values},))"]


def _single(field: Field) -> list[str]:
    kind, name = field.type, field.name
    own = f"self._{name}"
    if kind.item in INTEGERS:
        low, high = LIMITS[kind.item]
        return [
            f"value = {own}",
            f"new._{name} = value if value.__class__ is int and {low} <= value <= {high} "
            f"else _to_int(self, '{name}', {low}, {high})",
        ]
    if kind.item in EXACT and not kind.limit:
        cls = EXACT[kind.item]
        convert = {"bool": "_to_bool", "float": "_to_float", "str": "_to_str"}[cls]
        fits = f"value.__class__ is {cls}" + (" and value.isascii() and '\\0' not in value" if cls == "str" else "")
        return [f"value = {own}", f"new._{name} = value if {fits} else {convert}(self, '{name}')"]
    if kind.limit:
        return [f"new._{name} = _to_str(self, '{name}', {kind.limit})"]
    return [f"new._{name} = _to_octet(self, '{name}')"]


def _many(field: Field, module_of: dict[str, str]) -> list[str]:
    kind, name = field.type, field.name
    if kind.size and kind.item in DTYPES:
        return [f"new._{name} = _to_fixed(self, '{name}', '{DTYPES[kind.item]}', {kind.size})"]
    if kind.item in TYPECODES:
        bound = f"if len(self._{name}) > {kind.bound}: _too_long(self, '{name}', {kind.bound})"
        return [*([bound] if kind.bound else []), f"new._{name} = self._{name}[:]"]
    if kind.primitive:
        convert = {"boolean": "bool", "octet": "bytes"}.get(kind.item, "str")
        return [f"new._{name} = _to_list(self, '{name}', {convert}, {kind.size}, {kind.bound}, {kind.limit})"]
    cls = module_of[kind.item]
    return [f"new._{name} = _to_messages(self, '{name}', {cls}, {kind.size}, {kind.bound})"]
