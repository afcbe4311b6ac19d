"""Parse the most common YAML 1.1 scalars; importing the YAML library takes a tenth of a short verb's time."""

from __future__ import annotations

import re

_INTEGER = re.compile(r"[-+]?(?:0|[1-9][0-9]{0,17})\Z", re.ASCII)
_REAL = re.compile(r"[-+]?[0-9]{1,17}\.[0-9]{1,17}\Z", re.ASCII)
_WORD = re.compile(r"[A-Za-z][A-Za-z_]*\Z", re.ASCII)
_TRUTHS = {
    spelled: value
    for words, value in ((("yes", "true", "on"), True), (("no", "false", "off"), False))
    for word in words
    for spelled in (word, word.title(), word.upper())
}
_NOTHING = ("null", "Null", "NULL")


def plain_scalar(text: str) -> bool | int | float | str | None:
    """Return the value of a number or a single word; None for anything else, which is left to the YAML library."""
    if _INTEGER.match(text):
        return int(text)
    if _REAL.match(text):
        return float(text)
    if _WORD.match(text) and text not in _NOTHING:
        return _TRUTHS.get(text, text)
    return None
