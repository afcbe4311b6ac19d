"""Arithmetic that people type: numbers, names, `+ - * / // % **`, brackets and a few functions; nothing else is run."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

Number: TypeAlias = "int | float"

LONGEST = 200
"""Letters of an expression at most."""
LARGEST = 400
"""Bits that a whole number may have, so that no typing error keeps the console busy."""

FUNCTIONS: Mapping[str, Any] = {
    **{"abs": abs, "min": min, "max": max, "round": round, "sqrt": math.sqrt},
    **{"exp": math.exp, "log": math.log, "sin": math.sin, "cos": math.cos, "tan": math.tan},
}
CONSTANTS: Mapping[str, Number] = {"pi": math.pi, "e": math.e}

_TWO: Mapping[type[ast.operator], Callable[[Number, Number], Number]] = {
    ast.Add: lambda left, right: left + right,
    ast.Sub: lambda left, right: left - right,
    ast.Mult: lambda left, right: left * right,
    ast.Div: lambda left, right: left / right,
    ast.FloorDiv: lambda left, right: left // right,
    ast.Mod: lambda left, right: left % right,
}
_ONE: Mapping[type[ast.unaryop], Callable[[Number], Number]] = {ast.UAdd: lambda one: one, ast.USub: lambda one: -one}


def evaluate(text: str, names: Mapping[str, Number] | None = None) -> Number:
    """The value of an expression; raises `ValueError` with what is wrong with it."""
    if len(text) > LONGEST:
        raise ValueError(f"an expression of more than {LONGEST} letters")
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, MemoryError, RecursionError):
        raise ValueError(f"'{_short(text)}' is no number and no expression such as 0.5*2") from None
    known = {**CONSTANTS, **(names or {})}
    try:
        return _value(tree.body, known)
    except ZeroDivisionError:
        raise ValueError("a division by zero") from None
    except (OverflowError, TypeError) as error:
        raise ValueError(f"'{_short(text)}' cannot be worked out: {error}") from None


def _value(tree: ast.expr, known: Mapping[str, Number]) -> Number:
    if isinstance(tree, ast.Constant) and type(tree.value) in (int, float):
        return _small(tree.value)  # type: ignore[arg-type] -- one of the two types
    if isinstance(tree, ast.Name):
        if tree.id not in known:
            raise ValueError(f"'{tree.id}' is none of {', '.join(sorted(known))}")
        return known[tree.id]
    if isinstance(tree, ast.UnaryOp) and type(tree.op) in _ONE:
        return _ONE[type(tree.op)](_value(tree.operand, known))
    if isinstance(tree, ast.BinOp):
        return _small(_both(tree, _value(tree.left, known), _value(tree.right, known)))
    if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name) and not tree.keywords:
        function = FUNCTIONS.get(tree.func.id)
        if function is None:
            raise ValueError(f"'{tree.func.id}' is none of {', '.join(FUNCTIONS)}")
        return _small(function(*(_value(each, known) for each in tree.args)))
    raise ValueError("only numbers, names, + - * / // % **, brackets and functions are understood")


def _both(tree: ast.BinOp, left: Number, right: Number) -> Number:
    if isinstance(tree.op, ast.Pow):
        if isinstance(left, int) and isinstance(right, int) and right >= 0:
            if left.bit_length() * right > LARGEST:
                raise ValueError("the number is too large")
            return left**right
        result: complex | float = float(left) ** float(right)
        if isinstance(result, complex):
            raise ValueError("the root of a negative number")
        return result
    if type(tree.op) not in _TWO:
        raise ValueError("only + - * / // % ** are understood")
    return _TWO[type(tree.op)](left, right)


def _small(value: Number) -> Number:
    if isinstance(value, int) and value.bit_length() > LARGEST:
        raise ValueError("the number is too large")
    return value


def _short(text: str) -> str:
    return text if len(text) <= 24 else f"{text[:23]}…"
