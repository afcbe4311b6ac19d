"""Converts the text that a user types for a field of a message to the field's value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import yaml
from bot_console.tui.console.topics.angles import parse_yaw, quaternion
from bot_console.tui.console.topics.interfaces import (
    INTEGERS,
    QUATERNION,
    REALS,
    TIMES,
    element_type,
    full_type_name,
    interface,
    is_message,
)
from bot_console.tui.console.topics.port import Payload
from bot_console.tui.text.yaml_faults import UNREADABLE
from rosidl_runtime_py import set_message_fields

NOW = "now"
TRUE, FALSE = ("true", "yes", "on", "1"), ("false", "no", "off", "0")


def parse(kind: str, text: str, names: Mapping[int, str] | None = None) -> Any:
    """Parse the text for a field of type `kind`; raises `ValueError` with what would be valid.

    A quaternion is given as a yaw (`90°`, `1.57`), a time as `now` (the result is None) or in seconds, an array in YAML
    as `[1.0, 2.0]`.
    """
    words = text.strip()
    if kind in INTEGERS or kind == "octet":
        return _integer(kind, words, names or {})
    if kind in REALS:
        return _real(words)
    if kind == "boolean":
        if words.lower() in TRUE + FALSE:
            return words.lower() in TRUE
        raise ValueError(f"'{words}' is neither true nor false")
    if kind == QUATERNION:
        x, y, z, w = quaternion(parse_yaw(words))
        return _message(kind, {"x": x, "y": y, "z": z, "w": w})
    if kind in TIMES:
        return _time(kind, words)
    if element := element_type(kind):
        return _array(kind, element, words)
    if is_message(kind):
        return _message(kind, _yaml(words, dict, "{x: 1.0}"))
    return text


def _integer(kind: str, words: str, names: Mapping[int, str]) -> int | bytes:
    known = {name.lower(): value for value, name in names.items()}
    first, _, rest = words.partition(" ")
    try:
        named = known.get(words.lower())
        value = int(first if rest.lower() in known else words, 0) if named is None else named
    except ValueError:
        choices = f" or one of {', '.join(name for _, name in sorted(names.items()))}" if names else ""
        raise ValueError(f"'{words}' is not an integer{choices}") from None
    bits = INTEGERS.get(kind, 8)
    low, high = (
        (0, 2**bits - 1) if kind.startswith("u") or kind == "octet" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    )
    if not low <= value <= high:
        raise ValueError(f"{value} does not fit into {kind}: {low} .. {high}")
    return bytes([value]) if kind == "octet" else value


def _real(words: str) -> float:
    for unit in ("°", "deg"):
        if words.endswith(unit):
            return math.radians(_real(words.removesuffix(unit).strip()))
    try:
        return float(words.replace(".inf", "inf").replace(".nan", "nan"))
    except ValueError:
        raise ValueError(f"'{words}' is not a number") from None


def _time(kind: str, words: str) -> Any:
    if words == NOW:
        return None
    seconds = _real(words.removesuffix("s").strip())
    if not math.isfinite(seconds) or not -(2**31) <= seconds < 2**31 or (kind == TIMES[0] and seconds < 0):
        raise ValueError(f"'{words}' is not a time; write now, or seconds")
    whole = math.floor(seconds)
    return _message(kind, {"sec": whole, "nanosec": min(999_999_999, round((seconds - whole) * 1e9))})


def _array(kind: str, element: str, words: str) -> Any:
    value = _yaml(words, list, "[1.0, 2.0]")
    if not is_message(element):
        value = [parse(element, str(each)) for each in value]
    else:
        value = [_message(element, each) for each in value]
    length = kind.rpartition("[")[2].removesuffix("]") if kind.endswith("]") else ""
    if length and len(value) != int(length):
        raise ValueError(f"{len(value)} elements, but the array has {length}")
    return value


def _yaml(words: str, shape: type, example: str) -> Any:
    try:
        value = yaml.safe_load(words) if words else shape()
    except UNREADABLE:
        value = None
    if not isinstance(value, shape):
        raise ValueError(f"write it as in YAML: {example}")
    return value


def _message(kind: str, values: Any) -> Any:
    message = interface(Payload.MESSAGE, full_type_name(kind))()
    try:
        set_message_fields(message, values)
    except (AttributeError, TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{kind}: {error}") from None
    return message
