"""Reads and writes YAML's flow syntax on one line: quoted texts, and lists of scalars. Standard library only."""

from __future__ import annotations

import re
from collections.abc import Iterator

_PLAIN = re.compile(r"[A-Za-z_/](?:[\w/. -]*[\w/.-])?", re.ASCII)
_WORDS = frozenset(("y", "n", "yes", "no", "on", "off", "true", "false", "null", "nan", "inf", "infinity"))
"""Words that YAML or ROS does not read as text."""

_ESCAPES = dict(zip('0abtnvfre "/\\N_LP', '\0\a\b\t\n\v\f\r\x1b "/\\\x85\xa0\u2028\u2029', strict=True))
_BY_CODE = {"x": 2, "u": 4, "U": 8}
_NAMED = {"\n": r"\n", "\t": r"\t", "\r": r"\r", '"': r"\"", "\\": r"\\"}
_ITEM = re.compile(r"""\s*(?:("(?:[^"\\]|\\.)*")|('(?:[^']|'')*')|([^,"'\[\]{}][^,\[\]{}]*))?\s*(,|\Z)""", re.DOTALL)


def is_plain(text: str) -> bool:
    """Whether every YAML dialect of ROS reads the unquoted text as this text."""
    return bool(_PLAIN.fullmatch(text)) and text.lower() not in _WORDS


def quoted(text: str) -> str:
    """A text in double quotes, with escapes for unprintable characters."""
    return '"' + "".join(each if each.isprintable() and each not in _NAMED else _escaped(each) for each in text) + '"'


def _escaped(character: str) -> str:
    code = ord(character)
    if character in _NAMED:
        return _NAMED[character]
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def unquoted(text: str) -> str:
    """The contents of a text in quotes of either kind; raises `ValueError` for an unknown escape."""
    if text.startswith("'"):
        return text[1:-1].replace("''", "'")
    return re.sub(r"\\(x..|u.{4}|U.{8}|.)", lambda found: _meant(found[1]), text[1:-1], flags=re.DOTALL)


def _meant(escape: str) -> str:
    try:
        return chr(int(escape[1:], 16)) if _BY_CODE.get(escape[0]) == len(escape) - 1 else _ESCAPES[escape]
    except (KeyError, ValueError, OverflowError):
        raise ValueError(f"\\{escape} is not an escape; a backslash is written \\\\") from None


def in_quotes(text: str) -> bool:
    """Whether a text is a single quoted scalar."""
    found = _ITEM.match(text)
    return found is not None and found.end() == len(text) and not found[4] and (found[1] or found[2]) is not None


def items(text: str) -> Iterator[tuple[str, bool]]:
    """The elements of a list such as `[a, "b, d"]`, each with whether it was quoted; raises `ValueError`.

    The brackets may be left out.
    """
    inside = text.strip()
    if inside.startswith("[") != inside.endswith("]") or not inside:
        raise ValueError("a list begins with [ and ends with ]; an empty one is []")
    inside = inside.removeprefix("[").removesuffix("]").strip()
    at = 0
    while at < len(inside):
        found = _ITEM.match(inside, at)
        if found is None or (found[4] == "," and not any(found.groups()[:3])):
            raise ValueError(f"after '{inside[:at][-20:]}' an element is missing, or needs double quotes")
        scalar = found[1] or found[2]
        yield (unquoted(scalar), True) if scalar is not None else (found[3].strip(), False)
        at = found.end()
