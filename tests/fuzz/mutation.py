"""Inputs derived from valid ones: cut, joined, repeated, and mixed with text that tends to break parsers."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence

NASTY = (
    "",
    "\0",
    "\r",
    "\r\r",
    "\n",
    "\t",
    " ",
    "\x1b[2J",
    "\x1b]0;x\x07",
    "\x9b31m",
    "\u202e",
    "\u200b",
    "\ufeff",
    "\ud800",
    "😀",
    "ä",
    "[/",
    "[bold",
    "[link=x]",
    "{",
    "}",
    "{}",
    "{{",
    "${",
    "$(",
    ")",
    "$(env ",
    "$(var x)",
    "$(eval 1/0)",
    "(",
    "[",
    "]",
    "%s",
    "%%",
    "'",
    '"',
    "`",
    "\\",
    "\\\\",
    "/",
    "//",
    "~",
    "~x/",
    "../",
    ":",
    ": ",
    "- ",
    "---",
    "...",
    "?",
    "? ",
    "&a ",
    "*a",
    "<<: *a",
    "!!timestamp 2001-01-01",
    "!!python/object:os.system x",
    "!!binary x",
    "!!set {a}",
    "!!int x",
    "| ",
    ">-\n",
    "#",
    "# ",
    ",",
    ",,",
    "=",
    ":=",
    "==",
    "<",
    "</",
    "<a>",
    "&lt;",
    "<!ENTITY x 'y'>",
    "0",
    "-0",
    "-1",
    "1e999",
    "-1e999",
    "nan",
    ".nan",
    ".inf",
    "inf",
    "0x",
    "0xg",
    "0b2",
    "1_0",
    "1e",
    "1.",
    ".5",
    "09",
    "9" * 30,
    "9" * 5000,
    "true",
    "True",
    "yes",
    "null",
    "None",
    "~",
    "[]",
    "[1, a]",
    "[[1], 2]",
    "{a: 1}",
    "{1: {2: 3}}",
    "re:",
    "re:(",
    "re:(.|\\w)*%%",
    "sev:",
    "node:",
    "!",
    "--",
    "-",
    "--ros-args",
    "-p",
    "-r",
    "-h",
    "--help",
    "std_msgs/msg/String",
    "string",
    "int32[]",
    "uint8[<=3]",
    "float64[",
    "string<=",
    "ranges[",
    "[0]",
    "[-1]",
    "[99999999999]",
    "a" * 300,
    "(" * 200,
    "[" * 200,
    "{a: " * 200,
    "- " * 200,
    "a/" * 200,
    "\x00\xff",
    "\\u0000",
    "\\x00",
)
NUMBERS = (
    "0", "-0.0", "-1", "1e-320", "1e308", "-1e308", "1e999", ".nan", ".inf", "-.inf", "nan", "inf", "1" + "0" * 400,
    "-1" + "0" * 400, "9" * 5000, "0x" + "f" * 5000, "0b" + "1" * 20000, "0" + "7" * 6000, "9223372036854775808",
    "-9223372036854775809", "18446744073709551616", "4294967296", "256", "59:59:59", "1_000", "1.0.0", "2001-01-01",
    "true", "null", "text", "''", "[]", "{}", "[[1.0], 2]", "!!float", "!!int", "*a",
)  # fmt: skip
"""Replacements for a number, in any notation of YAML, Python and XML."""
MAX_BYTES = 20_000
"""Maximum length of an input, in characters."""


def mutated(seeds: Sequence[str], chance: random.Random) -> str:
    """Return one of the valid inputs, changed in one or several places."""
    text = chance.choice(seeds)
    for _ in range(chance.choice((1, 1, 1, 2, 2, 3, 5, 8))):
        text = chance.choice(CHANGES)(text, seeds, chance)
    return text[:MAX_BYTES]


def _place(text: str, chance: random.Random) -> int:
    return chance.randint(0, len(text))


def _insert(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    at = _place(text, chance)
    return text[:at] + chance.choice(NASTY) + text[at:]


def _replace(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    at = _place(text, chance)
    return text[:at] + chance.choice(NASTY) + text[at + chance.choice((1, 1, 2, 5, 20)) :]


def _cut(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    at = _place(text, chance)
    return text[:at] + text[at + chance.choice((1, 1, 3, 10, 100, 1000)) :]


def _truncate(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    return text[: _place(text, chance)]


def _repeat(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    at = _place(text, chance)
    length = chance.choice((1, 2, 5, 20, 80))
    return text[: at + length] + text[at : at + length] * chance.choice((1, 1, 2, 3, 50)) + text[at + length :]


def _splice(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    other = chance.choice(seeds)
    begin = _place(other, chance)
    at = _place(text, chance)
    return text[:at] + other[begin : begin + chance.choice((3, 10, 50, 500))] + text[at:]


def _number(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    found = list(re.finditer(r"-?\d+(?:\.\d+)?", text))
    if not found:
        return _insert(text, seeds, chance)
    place = chance.choice(found)
    return text[: place.start()] + chance.choice(NUMBERS) + text[place.end() :]


def _value(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    found = list(re.finditer(r"(?<=: )[^\n#,}\]]+|(?<==)[^\s]+", text))
    if not found:
        return _insert(text, seeds, chance)
    place = chance.choice(found)
    return text[: place.start()] + chance.choice((*NUMBERS, *NASTY)) + text[place.end() :]


def _swap_lines(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    lines = text.split("\n")
    one, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    lines[one], lines[other] = lines[other], lines[one]
    return "\n".join(lines)


def _indent(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    lines = text.split("\n")
    number = chance.randrange(len(lines))
    lines[number] = chance.choice((" ", "  ", "\t", "")) + lines[number].lstrip(chance.choice((" ", "")))
    return "\n".join(lines)


def _flip(text: str, seeds: Sequence[str], chance: random.Random) -> str:
    if not text:
        return chr(chance.randrange(0x110000 - 0x900))
    at = chance.randrange(len(text))
    return text[:at] + chr(ord(text[at]) ^ (1 << chance.randrange(8))) + text[at + 1 :]


CHANGES = (
    _insert,
    _insert,
    _replace,
    _replace,
    _cut,
    _truncate,
    _repeat,
    _splice,
    _splice,
    _swap_lines,
    _indent,
    _flip,
    _number,
    _number,
    _value,
    _value,
)
