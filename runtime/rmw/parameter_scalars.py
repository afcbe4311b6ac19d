"""The type of a scalar in a parameter file or in `-p name:=value`, as rcl determines it.

The rules are those of C's `strtol` and `strtod` plus a list of words for booleans, not those of YAML: `1e3` is a
double, `010` is eight, `null` is a string.
"""

from __future__ import annotations

import math
import re

Scalar = bool | int | float | str

INT64_MIN = -(2**63)
INT64_MAX = 2**63 - 1

_TRUE = frozenset(["Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"])
_FALSE = frozenset(["N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"])
_NAN = frozenset((".nan", ".NaN", ".NAN"))
_INFINITE = re.compile(r"[+-]?\.(?:inf|Inf|INF)\Z")
_BLANKS = r"[ \t\n\v\f\r]*"
_INTEGER = re.compile(_BLANKS + r"([+-]?)(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)\Z", re.ASCII)
_DECIMAL = re.compile(_BLANKS + r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\Z", re.ASCII)
_HEXADECIMAL = re.compile(
    _BLANKS + r"([+-]?0[xX](?:[0-9a-fA-F]+(?:\.[0-9a-fA-F]*)?|\.[0-9a-fA-F]+)(?:[pP][+-]?[0-9]+)?)\Z", re.ASCII
)
_WORD = re.compile(_BLANKS + r"([+-]?)(inf|infinity|nan(?:\([0-9A-Za-z_]*\))?)\Z", re.IGNORECASE | re.ASCII)


def scalar_value(text: str) -> Scalar:
    """Return the value of an unquoted scalar: bool, int (64 bits), float or otherwise the text itself."""
    if text in _TRUE:
        return True
    if text in _FALSE:
        return False
    integer = _integer(text)
    if integer is not None:
        return integer
    number = _double(text)
    return text if number is None else number


MAX_DIGITS = 19
"""Number of decimal digits of the largest integer; Python refuses to convert more than 4,300."""


def _base(digits: str) -> int:
    """Return the base that `strtol` infers from the first digits."""
    if digits[:2] in ("0x", "0X"):
        return 16
    return 8 if digits[0] == "0" else 10


def _integer(text: str) -> int | None:
    found = _INTEGER.match(text)
    if found is None:
        return None
    digits = found[2]
    base = _base(digits)
    if base == 10 and len(digits) > MAX_DIGITS:
        return None
    value = int(digits, base)
    if found[1] == "-":
        value = -value
    return value if INT64_MIN <= value <= INT64_MAX else None


def _double(text: str) -> float | None:
    """Parse a double; None if the text is not a number or is out of a double's range."""
    if text in _NAN:
        return math.nan
    if _INFINITE.match(text):
        return -math.inf if text[0] == "-" else math.inf
    found = _WORD.match(text)
    if found:
        value = math.inf if found[2][0] in "iI" else math.nan
        return -value if found[1] == "-" else value
    found = _DECIMAL.match(text)
    if found:
        value = float(found[1])
        return None if math.isinf(value) or _lost_digits(found[1], value) else value
    found = _HEXADECIMAL.match(text)
    if found:
        try:
            return float.fromhex(found[1])
        except OverflowError:
            return None
    return None


def _lost_digits(text: str, value: float) -> bool:
    """Whether a number is so small that a double cannot hold it exactly, which is a range error for `strtod`."""
    if abs(value) >= 2.0**-1022:
        return False
    from fractions import Fraction

    return Fraction(_shortened(text)) != Fraction(value)


def _shortened(text: str) -> str:
    """Return the same number, or another one that is just as small, in a form that `Fraction` can handle quickly."""
    mantissa, _, exponent = text.lower().partition("e")
    return f"{mantissa}e{max(int(exponent), -1100 - len(mantissa))}" if exponent else mantissa
