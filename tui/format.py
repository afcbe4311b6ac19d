"""Values, severities and other things as text; pure functions."""

from __future__ import annotations

import math
import re
import time
from shlex import quote

from bot_console.tui.console.model import ConsoleSnapshot, Kind, ParameterInfo, Range, Severity, Value
from bot_console.tui.console.parameter_types import ARRAYS
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import number_text, value_text, yaml_text
from bot_console.tui.text.yaml_flow import in_quotes, items, quoted, unquoted

SEVERITY_CHARACTERS = {
    Severity.UNSET: " ",
    Severity.DEBUG: "D",
    Severity.INFO: "I",
    Severity.WARN: "W",
    Severity.ERROR: "E",
    Severity.FATAL: "F",
}


def profile_label(snapshot: ConsoleSnapshot) -> str:
    """The name of the active profile and the number of values that differ from it; empty if no profile is active."""
    changed = f", {snapshot.profile_changes} changed" if snapshot.profile_changes else ""
    return sanitize(snapshot.active_profile) + changed if snapshot.active_profile else ""


def field_text(value: Value) -> str:
    """A value as text to edit, from which `parse_value` makes exactly that value again."""
    if isinstance(value, str):
        plain = value.isprintable() and value == value.strip() and value[:1] not in ('"', "'")
        return value if plain else quoted(value)
    return "" if value is None else value_text(value, exact=True)


def figure(value: float, sign: str = "") -> str:
    """A measured number with one decimal place, kept short whatever a node sends; `sign` as in a format spec."""
    return f"{value:{sign}.1f}" if abs(value) < 1e5 else f"{value:{sign}.0e}"


def range_text(limits: Range | None, kind: Kind) -> str:
    """A range as `0.1 .. 5.0`, with its step if it has one."""
    if limits is None:
        return ""

    def show(value: float) -> str:
        return number_text(value) if kind is Kind.DOUBLE else str(int(value))

    step = f" step {show(limits.step)}" if limits.step else ""
    return f"{show(limits.low)} .. {show(limits.high)}{step}"


def parse_value(text: str, parameter: ParameterInfo) -> Value:
    """A value of the parameter's kind from what a person typed; raises `ValueError` that says how to fix it.

    A double accepts `2` too, since nobody means an integer there. Text in quotes is read as YAML does.
    """
    kind = parameter.kind
    if kind is Kind.STRING:
        return unquoted(text.strip()) if in_quotes(text.strip()) else text
    text = text.strip()
    if kind in ARRAYS:
        return tuple(_element(each, quotes, kind) for each, quotes in items(text))
    return _scalar(text, kind)


def _scalar(text: str, kind: Kind) -> bool | int | float | str:
    if kind is Kind.BOOL:
        if text.lower() in ("true", "yes", "on", "1", "t", "y"):
            return True
        if text.lower() in ("false", "no", "off", "0", "f", "n"):
            return False
        raise ValueError(f"'{_short(text)}' is neither true nor false" if text.strip() else "type true or false")
    if kind is Kind.INTEGER:
        return _integer(text)
    return parse_number(text) if kind is Kind.DOUBLE else guess(text)


def _short(text: str) -> str:
    return text if len(text) <= 24 else f"{text[:23]}…"


def _integer(text: str) -> int:
    if not text.strip():
        raise ValueError("type an integer")
    try:
        value = int(text, 0)
    except ValueError:
        # Python refuses to convert more than 4,300 digits.
        wide = text.lstrip("+-").isdecimal() and len(text) > 4000
        raise ValueError(f"'{_short(text)}' {'does not fit into 64 bits' if wide else 'is not an integer'}") from None
    if not -(2**63) <= value < 2**63:
        raise ValueError(f"'{_short(text)}' does not fit into 64 bits")
    return value


def parse_number(text: str) -> float:
    """A floating-point number, `.inf` and `.nan` as in YAML; raises `ValueError`."""
    if not text.strip():
        raise ValueError("type a number")
    try:
        value = float(text.replace(".inf", "inf").replace(".nan", "nan"))
    except ValueError:
        raise ValueError(f"'{_short(text)}' is not a number") from None
    if math.isinf(value) and "inf" not in text.lower():
        raise ValueError(f"'{_short(text)}' is too large for a double")
    return value


def guess(text: str) -> bool | int | float | str:
    """A value of the kind that the text looks like; raises `ValueError` for a number that is too large."""
    if re.fullmatch(r"[+-]?(0[xX])?[0-9]+", text):
        return _integer(text)
    for convert in (lambda: int(text, 0), lambda: float(text)):
        try:
            return convert()
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text.lower(), text)


def element_text(value: bool | int | float | str | bytes) -> str:
    """An element of an array as text to edit, from which `parse_element` makes exactly that element again."""
    return f"0x{value.hex()}" if isinstance(value, bytes) else field_text(value)


def parse_element(text: str, array: Kind) -> bool | int | float | str | bytes:
    """An element of an array of that kind from what a person typed; raises `ValueError` that says how to fix it."""
    if array is Kind.STRING_ARRAY:
        return unquoted(text.strip()) if in_quotes(text.strip()) else text
    return _element(text.strip(), in_quotes(text.strip()), array)


def _element(text: str, quotes: bool, array: Kind) -> bool | int | float | str | bytes:
    if array is Kind.STRING_ARRAY:
        return text
    if quotes:
        raise ValueError(f"'{_short(text)}' stands in quotes, which makes it a text")
    return _byte(text) if array is Kind.BYTE_ARRAY else _scalar(text, ARRAYS[array])


def _byte(text: str) -> bytes:
    try:
        return bytes([int(text, 0)])
    except ValueError:
        raise ValueError(f"'{_short(text)}' is not a byte: 0x00 .. 0xff, or 0 .. 255") from None


def command_of(parameter: ParameterInfo, value: Value) -> str:
    """The equivalent `ros2` command, quoted for a shell; if there is none, a shell comment that says why."""
    if value is None or value == () or parameter.kind is Kind.BYTE_ARRAY:
        what = "removes a value" if value is None else "sets an empty array" if value == () else "sets bytes"
        return f"# no ros2 param command {what}"
    text = yaml_text(value) if isinstance(value, str) else value_text(value, exact=True)
    # To ros2, a word that begins with a dash is an option unless it contains a blank, which YAML ignores.
    text = f" {text}" if text.startswith("-") and not re.fullmatch(r"-\d+|-\d*\.\d+", text) else text
    return f"ros2 param set {quote(parameter.node)} {quote(parameter.name)} {quote(text)}"


def clock_text(stamp: int) -> str:
    """Hours, minutes, seconds and milliseconds of a time since the epoch (ns), in local time."""
    return time.strftime("%H:%M:%S", time.localtime(stamp // 10**9)) + f".{stamp // 10**6 % 1000:03d}"
