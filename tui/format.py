"""Values, severities and other things as text; pure functions."""

from __future__ import annotations

import math
import unicodedata

from bot_console.tui.console.model import Kind, ParameterInfo, Range, Severity, Value

WIDE_MARK = "\ufe0f"
"""Asks for a symbol in colour; terminals disagree whether that makes it one cell wide or two."""

LETTERS = {
    Severity.UNSET: " ",
    Severity.DEBUG: "D",
    Severity.INFO: "I",
    Severity.WARN: "W",
    Severity.ERROR: "E",
    Severity.FATAL: "F",
}


def counted(number: int, word: str) -> str:
    """A number and a word, in the plural where it belongs."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def value_text(value: Value) -> str:
    """A parameter's value as YAML writes it on one line."""
    if value is None:
        return "not set"
    if isinstance(value, tuple):
        return "[" + ", ".join(value_text(each) if not isinstance(each, bytes) else each.hex() for each in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return number_text(value) if isinstance(value, float) else str(value)


def number_text(value: float) -> str:
    """A double with its decimal point, so that it can be told from an integer."""
    if not math.isfinite(value):
        return ".nan" if math.isnan(value) else (".inf" if value > 0 else "-.inf")
    text = f"{value:.10g}"
    return text if any(letter in text for letter in ".en") else text + ".0"


def range_text(limits: Range | None, kind: Kind) -> str:
    """A range as `0.1 .. 5.0`, with its step when it has one."""
    if limits is None:
        return ""

    def show(value: float) -> str:
        return number_text(value) if kind is Kind.DOUBLE else str(int(value))

    step = f" step {show(limits.step)}" if limits.step else ""
    return f"{show(limits.low)} .. {show(limits.high)}{step}"


def parse_value(text: str, parameter: ParameterInfo) -> Value:
    """What a person typed as a value of the parameter's kind; raises `ValueError` with a mend.

    A double takes `2`, too, since nobody means an integer there.
    """
    text = text.strip()
    kind = parameter.kind
    if kind is Kind.STRING:
        return text
    if kind is Kind.BOOL:
        if text.lower() in ("true", "yes", "on", "1", "t", "y"):
            return True
        if text.lower() in ("false", "no", "off", "0", "f", "n"):
            return False
        raise ValueError(f"'{text}' is neither true nor false")
    if kind is Kind.INTEGER:
        try:
            return int(text, 0)
        except ValueError:
            raise ValueError(f"'{text}' is no integer") from None
    if kind is Kind.DOUBLE:
        return parse_number(text)
    if kind >= Kind.BYTE_ARRAY:
        return _parse_array(text, kind)
    return guess(text)


def parse_number(text: str) -> float:
    """A floating-point number, `.inf` and `.nan` as in YAML; raises `ValueError`."""
    try:
        return float(text.replace(".inf", "inf").replace(".nan", "nan"))
    except ValueError:
        raise ValueError(f"'{text}' is no number") from None


def guess(text: str) -> Value:
    """A value of whatever kind the text looks like."""
    for convert in (lambda: int(text, 0), lambda: float(text)):
        try:
            return convert()
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text.lower(), text)


ELEMENTS = {
    Kind.BOOL_ARRAY: Kind.BOOL,
    Kind.INTEGER_ARRAY: Kind.INTEGER,
    Kind.DOUBLE_ARRAY: Kind.DOUBLE,
    Kind.STRING_ARRAY: Kind.STRING,
}


def _parse_array(text: str, kind: Kind) -> Value:
    inside = text.removeprefix("[").removesuffix("]").strip()
    parts = [each.strip().strip("\"'") for each in inside.split(",")] if inside else []
    if kind is Kind.BYTE_ARRAY:
        try:
            return tuple(bytes([int(each, 16)]) for each in parts)
        except ValueError:
            raise ValueError("bytes are written as two hexadecimal digits, such as [0a, ff]") from None
    element = ParameterInfo("", "", ELEMENTS[kind], None)
    values = [parse_value(each, element) for each in parts]
    return tuple(each for each in values if not isinstance(each, tuple) and each is not None)


def harmless(text: str) -> str:
    """A text with control characters and bidirectional marks made visible, so that none acts on the screen."""
    text = text.replace(WIDE_MARK, "")
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() or each == " " else _visible(each) for each in text)


def _visible(letter: str) -> str:
    code = ord(letter)
    if letter == "\t":
        return "    "
    if letter == "\n":
        return "⏎ "
    if code < 32:
        return chr(0x2400 + code)
    return "␡" if code == 127 else ("" if unicodedata.category(letter) == "Cf" else "�")


def command_of(parameter: ParameterInfo, value: Value) -> str:
    """The `ros2` command that does the same."""
    text = value_text(value)
    quoted = f"'{text}'" if any(letter in text for letter in ' "[]{}:#&*!|>%@`$()<>;?\\') or not text else text
    return f"ros2 param set {parameter.node} {parameter.name} {quoted}"


def clock_text(stamp: int) -> str:
    """Hours, minutes, seconds and milliseconds of a time since the epoch (ns), in local time."""
    import time

    return time.strftime("%H:%M:%S", time.localtime(stamp // 10**9)) + f".{stamp // 10**6 % 1000:03d}"
