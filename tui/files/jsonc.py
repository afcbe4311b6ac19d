"""Reads JSON with comments and trailing commas, the format of editors' settings, and edits it, keeping the comments."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

_TOKEN = re.compile(
    r"""(?P<space>\s+|//[^\n]*|/\*.*?\*/)|(?P<string>"(?:[^"\\\n]|\\.)*")|(?P<mark>[{}\[\]:,])|(?P<word>[^\s{}\[\]:,"/]+)""",
    re.DOTALL,
)


class JsoncError(ValueError):
    """The text cannot be read, or does not have the expected shape; the message says where and why."""


class _Token(NamedTuple):
    kind: str
    start: int
    end: int


class _Element(NamedTuple):
    """A value of an array, or of an object with its key."""

    key: str
    start: int
    end: int


def load(text: str) -> Any:
    """The value of a text; raises `JsoncError`."""
    tokens = _tokens(text)
    kept = [
        token
        for token, following in zip(tokens, [*tokens[1:], None], strict=True)
        if not (following and _is(text, token, ",") and text[following.start] in "}]")
    ]
    try:
        return json.loads(" ".join(text[each.start : each.end] for each in kept))
    except (ValueError, RecursionError) as error:
        line = _line_of_fault(text, kept, error)
        raise JsoncError(f"line {line}: it is not JSON: {getattr(error, 'msg', error)}") from None


def with_member(text: str, key: str, value: Any) -> str:
    """The text of an object with a member added in front, unless it already has one of that name."""
    found = load(text)
    if not isinstance(found, dict):
        raise JsoncError("it is no JSON object")
    if key in found:
        return text
    opening = _tokens(text)[0].end
    comma = "," if found else ""
    end = "" if text[opening : opening + 1] in ("\r", "\n") else "\n"
    return f"{text[:opening]}\n    {json.dumps(key)}: {_shown(value)}{comma}{end}{text[opening:]}"


def with_strings(text: str, key: str, wanted: Sequence[str], is_old: Callable[[str], bool]) -> str:
    """The text of an object whose array `key` has all the wanted strings, and none for which `is_old` is true."""
    text = with_member(text, key, [])
    found = load(text)[key]
    if not isinstance(found, list):
        raise JsoncError(f"{json.dumps(key)} is not a list")
    member = [each for each in _elements(text, _tokens(text)) if each.key == key][-1]
    inside = [each for each in _tokens(text) if each.start >= member.start]
    items = _elements(text, inside)
    present = [json.loads(text[each.start : each.end]) if text[each.start] == '"' else None for each in items]
    for item, value in reversed([*zip(items, present, strict=True)]):
        if isinstance(value, str) and is_old(value) and value not in wanted:
            text = _without(text, item, inside)
            return with_strings(text, key, wanted, is_old)
    added = [json.dumps(each) for each in wanted if each not in present]
    return _appended(text, inside, items, added) if added else text


def _appended(text: str, array: Sequence[_Token], items: Sequence[_Element], added: Sequence[str]) -> str:
    """The text with elements added to an array, after a comment on the line of its last one."""
    shown = "".join(f"\n        {each}," for each in added).removesuffix(",")
    if not items:
        place = array[0].end
        return f"{text[:place]}{shown}\n    {text[place:].lstrip()}"
    following = next(each for each in array if each.start >= items[-1].end)
    comma = _is(text, following, ",")
    place = following.end if comma else items[-1].end
    closing = next(each for each in array if each.start >= place).start
    beside = text[place:closing].partition("\n")[0]
    if comma:
        shown += ","
    else:
        text, place = f"{text[:place]},{text[place:]}", place + 1
    place += 0 if "/*" in beside else len(beside.rstrip())
    return f"{text[:place]}{shown}{text[place:]}"


def _without(text: str, item: _Element, tokens: Sequence[_Token]) -> str:
    """The text without an element and its comma."""
    at = next(index for index, each in enumerate(tokens) if each.start >= item.end)
    if _is(text, tokens[at], ","):
        rest = text[tokens[at].end :]
        return text[: item.start] + rest.lstrip(" \t\r\n")
    before = next((each for each in reversed(tokens) if each.end <= item.start), None)
    if before is not None and _is(text, before, ","):
        return text[: before.start] + text[before.end : item.start].rstrip() + text[item.end :]
    return text[: item.start] + text[item.end :]


def _elements(text: str, tokens: Sequence[_Token]) -> list[_Element]:
    """The direct elements of the array or object that begins with the first token."""
    found: list[_Element] = []
    depth, key, index = 0, "", 0
    while index < len(tokens):
        token = tokens[index]
        mark = text[token.start] if token.kind == "mark" else ""
        if depth == 1 and mark not in ("]", "}", ",", ":"):
            if index + 1 < len(tokens) and _is(text, tokens[index + 1], ":"):
                key, index = json.loads(text[token.start : token.end]), index + 2
            last = _last_of_value(text, tokens, index)
            found.append(_Element(key, tokens[index].start, tokens[last].end))
            key, index = "", last + 1
            continue
        depth += (mark in ("[", "{")) - (mark in ("]", "}"))
        if mark and depth == 0:
            break
        index += 1
    return found


def _last_of_value(text: str, tokens: Sequence[_Token], at: int) -> int:
    depth = 0
    for index in range(at, len(tokens)):
        mark = text[tokens[index].start] if tokens[index].kind == "mark" else ""
        depth += (mark in ("[", "{")) - (mark in ("]", "}"))
        if depth == 0:
            return index
    return len(tokens) - 1


def _tokens(text: str) -> list[_Token]:
    found: list[_Token] = []
    at = 1 if text.startswith("\ufeff") else 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise JsoncError(f"line {text.count(chr(10), 0, at) + 1}: it is not JSON")
        if match.lastgroup != "space":
            found.append(_Token(str(match.lastgroup), match.start(), match.end()))
        at = match.end()
    if not found:
        raise JsoncError("it is empty")
    return found


def _is(text: str, token: _Token, mark: str) -> bool:
    return token.kind == "mark" and text[token.start] == mark


def _line_of_fault(text: str, tokens: Sequence[_Token], error: Exception) -> int:
    position = getattr(error, "pos", 0)
    for each in tokens:
        if position <= each.end - each.start:
            return text.count("\n", 0, each.start) + 1
        position -= each.end - each.start + 1
    return text.count("\n") + 1


def _shown(value: Any) -> str:
    return json.dumps(value, indent=4).replace("\n", "\n    ")
