"""Turns typed text and key presses into new values. Pure."""

from __future__ import annotations

import math
from dataclasses import replace

from bot_console.tui.console.model import Kind, ParameterInfo, Value
from bot_console.tui.console.model.range import free_step, rounded
from bot_console.tui.console.parameter_types import ARRAYS
from bot_console.tui.format import parse_element, parse_value, range_text
from bot_console.tui.text.expression.numbers import evaluate
from bot_console.tui.text.expression.parse import NUMBER
from bot_console.tui.text.sanitize import cut
from bot_console.tui.text.typed_units import factor, split_unit

NUMBERS = (Kind.INTEGER, Kind.DOUBLE)
ARRAYS_OF_NUMBERS = (Kind.INTEGER_ARRAY, Kind.DOUBLE_ARRAY)
INTEGER_ENDS = (-(2**63), 2**63 - 1)
"""The smallest and the largest integer that a parameter can hold."""


def label(parameter: ParameterInfo) -> str:
    """The prompt for a parameter: name, type, range and unit."""
    facts = (parameter.kind.word, range_text(parameter.range, parameter.kind), parameter.unit)
    return f"{parameter.name} ({', '.join(each for each in facts if each)})"


def typed_value(text: str, parameter: ParameterInfo) -> Value:
    """The value of a typed text: YAML or, for a number, an expression that may end in a unit.

    Raises `ValueError` that says how to fix the text.
    """
    try:
        return parse_value(text, parameter)
    except ValueError:
        if parameter.kind not in NUMBERS or not any(character.isdigit() for character in text):
            raise
    return _calculated(text, parameter)


def typed_element(parameter: ParameterInfo, text: str) -> bool | int | float | str | bytes:
    """An element of an array from a typed text; for an array of numbers, expressions are allowed as in `typed_value`.

    Raises `ValueError` that says how to fix the text.
    """
    try:
        return parse_element(text, parameter.kind)
    except ValueError:
        if parameter.kind not in ARRAYS_OF_NUMBERS or not any(character.isdigit() for character in text):
            raise
    return _calculated(text, replace(parameter, kind=ARRAYS[parameter.kind]))


def _calculated(text: str, parameter: ParameterInfo) -> int | float:
    expression, unit = split_unit(text)
    scale = factor(unit, parameter.unit) if unit else 1
    value = evaluate(expression) * scale
    if not math.isfinite(value):
        literal = NUMBER.fullmatch(text.strip().lstrip("+-"))
        raise ValueError(f"'{cut(text, 24)}' is too large" if literal else "the result is not a finite number")
    if parameter.kind is Kind.DOUBLE:
        return float(f"{value:.12g}")  # 30 cm is 0.3 m exactly, despite binary rounding
    nearest = round(value)
    if abs(value - nearest) > 1e-9 * max(1.0, abs(value)):
        raise ValueError(f"{value:g} is not an integer")
    if not INTEGER_ENDS[0] <= nearest <= INTEGER_ENDS[1]:
        raise ValueError(f"{nearest} does not fit into 64 bits")
    return nearest


def value_problem(parameter: ParameterInfo, text: str) -> str:
    """The problem with a typed value; empty if there is none."""
    try:
        typed_value(text, parameter)
    except ValueError as error:
        return str(error)
    return ""


def is_number(value: Value) -> bool:
    """Whether a value can be changed in steps."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def moved_by_steps(parameter: ParameterInfo, value: Value, steps: int) -> Value:
    """A number moved by steps of its descriptor, or by hundredths of its range; without either, by about a tenth of
    itself. None if it cannot be moved.
    """
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return None
    whole = isinstance(value, int)
    if parameter.range:
        return parameter.range.moved(value, steps, whole=whole)
    if isinstance(value, int):
        return min(max(value + steps * max(1, abs(value) // 10), INTEGER_ENDS[0]), INTEGER_ENDS[1])
    step = free_step(value)
    moved = rounded(value + steps * step, step)
    return moved if math.isfinite(moved) else None


def at_share(parameter: ParameterInfo, share: float) -> Value:
    """The value at a share (0 to 1) of the range, on a step; None without a range."""
    limits = parameter.range
    if limits is None or not is_number(parameter.value):
        return None
    return limits.at_share(share, whole=parameter.kind is Kind.INTEGER)
