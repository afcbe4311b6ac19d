"""Writes most messages as YAML without the YAML library, whose import takes longer than a short verb.

The output is PyYAML's, or none: strings that might need quotes, and other rare cases, are left to the library.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

WORDS = frozenset({"yes", "no", "true", "false", "on", "off", "null"})
"""Words that YAML reads as something other than a string."""
SPECIAL = {"inf": ".inf", "-inf": "-.inf", "nan": ".nan"}


class _UncommonError(Exception):
    """A case that is left to the library."""


def block_yaml(values: Mapping[str, Any]) -> str | None:
    """Return the fields of a message, one per line; None if the library has to write them."""
    try:
        return "".join(_lines(values, "")) if values else None
    except _UncommonError:
        return None


def _lines(values: Mapping[str, Any], indent: str) -> Iterator[str]:
    for name, value in values.items():
        if name in WORDS:
            raise _UncommonError
        if value and isinstance(value, dict):
            yield f"{indent}{name}:\n"
            yield from _lines(value, indent + "  ")
        elif value and value.__class__ is list:
            yield f"{indent}{name}:\n"
            for each in value:
                yield f"{indent}- {_scalar(each)}\n"
        else:
            yield f"{indent}{name}: {_scalar(value)}\n"


def _scalar(value: Any) -> str:
    kind = value.__class__
    if kind is float:
        text = repr(value)
        return SPECIAL.get(text) or (text if "." in text else text.replace("e", ".0e"))
    if kind is int:
        return str(value)
    if kind is bool:
        return "true" if value else "false"
    if kind is str and _is_plain(value):
        return value or "''"
    if kind is list and not value:
        return "[]"
    raise _UncommonError


def _is_plain(text: str) -> bool:
    """Whether a string needs no quotes: it is empty, or ASCII words that begin with a letter."""
    if not text:
        return True
    words = text.replace("_", "a").split(" ")
    return text.isascii() and text[0].isalpha() and all(map(str.isalnum, words)) and text.lower() not in WORDS
