"""Parses `.msg`, `.srv` and `.action` files."""

from __future__ import annotations

import ast
import re

from bot_console.runtime.rosidl.definition import PRIMITIVES, Constant, Definition, Field, Interface, Type

LINE = re.compile(
    r"^(?P<type>[A-Za-z][\w/]*)(?:<=(?P<limit>\d+))?(?P<array>\[(?:<=)?\d*\])?\s+(?P<name>[A-Za-z]\w*)\s*(?P<rest>.*)$"
)
CONSTANT = re.compile(r"^[A-Z]([A-Z0-9_]*[A-Z0-9])?$")
FIELD = re.compile(r"^(?!.*__)(?!.*_$)[a-z][a-z0-9_]*$")
NAME = re.compile(r"^[A-Z][A-Za-z0-9]*$")
PARTS: dict[str, tuple[str, ...]] = {
    "msg": ("",),
    "srv": ("_Request", "_Response"),
    "action": ("_Goal", "_Result", "_Feedback"),
}
TEXTS = ("string", "wstring")


class DefinitionError(ValueError):
    """A definition file is invalid; the message has file and line."""


def parse(text: str, package: str, kind: str, name: str, file: str = "") -> Interface:
    """Parse the text of a definition file; raises `DefinitionError`."""
    names = PARTS[kind]
    where = file or f"{package}/{kind}/{name}"
    if not NAME.match(name):
        raise DefinitionError(
            f"{where}: '{name}' is not a valid interface name (a capital letter, then letters and digits)"
        )
    sections: list[list[tuple[int, str]]] = [[]]
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() == "---":
            sections.append([])
        else:
            sections[-1].append((number, line))
    if len(sections) != len(names):
        raise DefinitionError(f"{where}: a .{kind} file has {len(names) - 1} lines with '---', not {len(sections) - 1}")
    parts = [_part(name + suffix, rows, package, where) for suffix, rows in zip(names, sections, strict=True)]
    return Interface(package, kind, name, parts)


def _part(name: str, rows: list[tuple[int, str]], package: str, where: str) -> Definition:
    fields: list[Field] = []
    constants: list[Constant] = []
    for number, line in rows:
        bare = without_comment(line).strip()
        if not bare:
            continue
        try:
            row = _row(bare, package)
        except ValueError as error:
            raise DefinitionError(f"{where}:{number}: {error}: '{line.strip()}'") from None
        if isinstance(row, Constant):
            constants.append(row)
        else:
            fields.append(row)
    seen: set[str] = set()
    for each in [*fields, *constants]:
        if each.name in seen:
            raise DefinitionError(f"{where}: '{each.name}' is defined twice in {name}")
        seen.add(each.name)
    return Definition(name, fields, constants)


def without_comment(line: str) -> str:
    """Return a line up to its comment; a `#` inside quotes is not a comment."""
    quote = ""
    for index, character in enumerate(line):
        if quote:
            quote = "" if character == quote and line[index - 1] != "\\" else quote
        elif character in "\"'":
            quote = character
        elif character == "#":
            return line[:index]
    return line


def _row(line: str, package: str) -> Field | Constant:
    match = LINE.match(line)
    if not match:
        raise ValueError("expected 'type name', 'type name default' or 'type NAME=value'")
    kind, rest = _type(match, package), match["rest"].strip()
    name = match["name"]
    if rest.startswith("="):
        if not CONSTANT.match(name) or not kind.primitive or kind.sequence or kind.size:
            raise ValueError("a constant has a primitive type and a NAME in capitals")
        return Constant(name, _literal(rest[1:].strip(), kind), match["type"])
    if not FIELD.match(name):
        raise ValueError(f"'{name}' is not a field name (lower case letters, digits, single underscores)")
    return Field(name, kind, _default(rest, kind) if rest else None)


def _type(match: re.Match[str], package: str) -> Type:
    item, array = match["type"], match["array"] or ""
    if item in PRIMITIVES:
        item = PRIMITIVES[item]
    elif item == "Header":
        item = "std_msgs/Header"
    elif "/" not in item:
        item = f"{package}/{item}"
    else:
        item = item.replace("/msg/", "/")
    limit = int(match["limit"] or 0)
    inside = array.strip("[]")
    if not array:
        return Type(item, limit=limit)
    if inside.startswith("<="):
        return Type(item, sequence=True, bound=int(inside[2:]), limit=limit)
    return Type(item, size=int(inside), limit=limit) if inside else Type(item, sequence=True, limit=limit)


def _default(text: str, kind: Type) -> str:
    if not (kind.sequence or kind.size):
        return _literal(text, kind)
    try:
        values = ast.literal_eval(re.sub(r"\b(true|false)\b", lambda match: match[1].title(), text))
        return "[" + ", ".join(_literal(repr(value), kind) for value in values) + "]"
    except (SyntaxError, TypeError, ValueError, RecursionError, MemoryError):
        raise ValueError("the default of an array is a list such as [1, 2]") from None


def _literal(text: str, kind: Type) -> str:
    """Return the Python literal of a value as written in a definition file; raises `ValueError`."""
    if kind.item in TEXTS:
        return repr(_unquote(text))
    if kind.item == "boolean":
        if text.lower() not in ("true", "false", "0", "1"):
            raise ValueError(f"'{text}' is neither true nor false")
        return str(text.lower() in ("true", "1"))
    if kind.item in ("float", "double"):
        value = float(text)
        return repr(value) if value - value == 0 else f"float('{value}')"
    number = int(text, 0)
    return repr(bytes([number])) if kind.item == "octet" else str(number)


def _unquote(text: str) -> str:
    if len(text) > 1 and text[0] == text[-1] and text[0] in "\"'":
        return text[1:-1].replace("\\" + text[0], text[0])
    return text
