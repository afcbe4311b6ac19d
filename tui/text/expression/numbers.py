"""Evaluates expressions of numbers without running them as code."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from bot_console.tui.text.expression.parse import Incomplete, parse
from bot_console.tui.text.expression.tree import BinaryOperation, Call, Name, Negation, Path, Tree
from bot_console.tui.text.expression.tree import Number as Typed
from bot_console.tui.text.sanitize import cut

Number: TypeAlias = "int | float"

MAX_BITS = 400
"""Maximum bits of an integer, so that a typing error cannot keep the console busy."""

DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+")

FUNCTIONS: Mapping[str, Any] = {
    **{"abs": abs, "min": min, "max": max, "round": round, "sqrt": math.sqrt, "hypot": math.hypot},
    **{"exp": math.exp, "log": math.log, "sin": math.sin, "cos": math.cos, "tan": math.tan},
    **{"asin": math.asin, "acos": math.acos, "atan": math.atan, "atan2": math.atan2},
    **{"deg": math.degrees, "rad": math.radians},
}
CONSTANTS: Mapping[str, Number] = {"pi": math.pi, "e": math.e}

_TWO: Mapping[str, Callable[[Number, Number], Number]] = {
    "+": lambda left, right: left + right,
    "-": lambda left, right: left - right,
    "*": lambda left, right: left * right,
    "/": lambda left, right: left / right,
    "//": lambda left, right: left // right,
    "%": lambda left, right: left % right,
}


def evaluate(text: str, names: Mapping[str, Number] | None = None) -> Number:
    """The value of an expression; raises `ValueError` that says what is wrong with it."""
    try:
        tree = parse(text)
    except ValueError as error:
        if DECIMAL_COMMA.fullmatch(text.strip()):
            raise ValueError(f"decimals have a point: {text.strip().replace(',', '.')}") from None
        state = "incomplete" if isinstance(error, Incomplete) else "not a number"
        raise ValueError(f"'{cut(text, 24)}' is {state}: {error}") from None
    return value_of(tree, names or {}, cut(text, 24))


def value_of(tree: Tree, names: Mapping[str, Number], text: str = "it") -> Number:
    """The value of a parsed expression, given the values of its names and paths; raises `ValueError` as `evaluate`
    does.
    """
    try:
        return _value(tree, {**CONSTANTS, **names})
    except ZeroDivisionError:
        raise ValueError("a division by zero") from None
    except (OverflowError, TypeError) as error:
        raise ValueError(f"'{text}' cannot be worked out: {error}") from None


def _value(tree: Tree, known: Mapping[str, Number]) -> Number:
    if isinstance(tree, Typed):
        return _small(tree.value)
    if isinstance(tree, (Name, Path)):
        if tree.text not in known:
            raise ValueError(f"'{tree.text}' is not one of {', '.join(sorted(known))}")
        return known[tree.text]
    if isinstance(tree, Negation):
        return -_value(tree.of, known)
    if isinstance(tree, BinaryOperation):
        return _small(_both(tree.operator, _value(tree.left, known), _value(tree.right, known)))
    if isinstance(tree, Call):
        function = FUNCTIONS.get(tree.function)
        if function is None:
            raise ValueError(f"'{tree.function}' is not one of {', '.join(FUNCTIONS)}")
        return _small(function(*(_value(each, known) for each in tree.arguments)))
    raise ValueError("only numbers, names, + - * / // % **, brackets and functions are understood")


def _both(operator: str, left: Number, right: Number) -> Number:
    if operator != "**":
        return _TWO[operator](left, right)
    if isinstance(left, int) and isinstance(right, int) and right >= 0:
        if left.bit_length() * right > MAX_BITS:
            raise ValueError("the number is too large")
        return left**right
    result: complex | float = float(left) ** float(right)
    if isinstance(result, complex):
        raise ValueError("the root of a negative number")
    return result


def _small(value: Number) -> Number:
    if isinstance(value, int) and value.bit_length() > MAX_BITS:
        raise ValueError("the number is too large")
    return value
