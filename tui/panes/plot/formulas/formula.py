"""Expressions over curves: `/a/x - /b/x`, `deg(/yaw/data)`, `mean(/odom/..., 1 s)`; parsed, and evaluated in NumPy.

A formula has a value at each sample of the topic named first; every other path contributes its last value up to then.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from bot_console.tui.panes.plot.formulas.functions import NEIGHBOURS_PER_SIDE, OF_CURVES, OPERATORS, OVER_TIME, PLAIN
from bot_console.tui.text.expression.numbers import CONSTANTS
from bot_console.tui.text.expression.parse import parse
from bot_console.tui.text.expression.tree import (
    OF_ARRAYS,
    BinaryOperation,
    Call,
    Name,
    Negation,
    Number,
    Path,
    Span,
    Tree,
    children,
    is_parameter,
    paths_of,
    walk,
)

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class HeldValues:
    """The values of a path over time: each holds until the next one."""

    times: Array
    values: Array
    steps: bool = False
    """Whether the path is a parameter, which has no sample times of its own."""


@dataclass(frozen=True)
class Formula:
    """A valid, parsed expression over paths."""

    text: str
    tree: Tree
    paths: tuple[str, ...]

    @property
    def lead(self) -> str:
        """The path whose sample times the formula uses: the first topic; empty if there are parameters only."""
        return next((each for each in self.paths if not is_parameter(each)), "")

    def values(
        self, known: Mapping[str, HeldValues], start: float = -np.inf, end: float = np.inf
    ) -> tuple[Array, Array]:
        """Times (s) and values from `start` to `end`, plus one sample on either side."""
        times = self._times(known)
        back, before = _reach_back(self.tree)
        first = max(0, int(np.searchsorted(times, start - back)) - 1 - before)
        last = int(np.searchsorted(times, end, side="right")) + 1
        times = times[first : last + before]  # functions that need earlier samples may need as many later ones
        with np.errstate(all="ignore"):
            values = _evaluate(self.tree, times, known)
        shown = max(0, int(np.searchsorted(times, start)) - 1)
        return times[shown : last - first], values[shown : last - first]

    def _times(self, known: Mapping[str, HeldValues]) -> Array:
        if self.lead:
            return known[self.lead].times
        return np.unique(np.concatenate([known[each].times for each in self.paths]))


def parse_formula(text: str) -> Formula | str:
    """Parse a formula; returns the path if the text is only a path. Raises `ValueError` that says what is wrong."""
    tree = parse(text, paths=True)
    if isinstance(tree, Path):
        return tree.text
    paths = paths_of(tree)
    if not paths:
        raise ValueError("name a path, such as /odom/twist.twist.linear.x")
    for each in walk(tree):
        if isinstance(each, Call):
            _check_call(each)
        elif isinstance(each, Name) and each.text not in CONSTANTS:
            raise ValueError(f"'{each.text}' is not a path; paths begin with /")
        elif any(isinstance(part, Span) for part in children(each)):
            raise ValueError("a time span such as 1 s can only be the last argument of mean, min, max, std or rms")
    return Formula(text.strip(), tree, paths)


def split_expressions(text: str) -> list[str]:
    """Split expressions at commas outside brackets."""
    parts: list[str] = []
    depth = begin = 0
    for at, character in enumerate(text):
        depth += (character in "([") - (character in ")]")
        if character == "," and depth == 0:
            parts.append(text[begin:at])
            begin = at + 1
    return [each.strip() for each in (*parts, text[begin:]) if each.strip()]


def _check_call(call: Call) -> None:
    given, name = call.arguments, call.function
    if given and isinstance(given[-1], Span):
        if name not in OVER_TIME:
            raise ValueError(f"{name} takes no time span; {', '.join(OVER_TIME)} do")
        if len(given) != 2 or isinstance(given[0], Span):
            raise ValueError(f"write {name}(a path, 1 s)")
        if given[-1].seconds <= 0:
            raise ValueError("a time span must be longer than 0 s")
        return
    if any(isinstance(each, Span) for each in given):
        raise ValueError(f"the time span comes last: {name}(a path, 1 s)")
    if name in OF_CURVES:
        if len(given) != 1:
            raise ValueError(f"write {name}(a path)")
        return
    if name not in PLAIN:
        if name in OVER_TIME:
            of_array = f", or {name} of an array such as {name}(/scan/ranges)" if name in OF_ARRAYS else ""
            raise ValueError(f"write {name}(a path, 1 s){of_array}")
        raise ValueError(
            f"'{name}' is not one of {', '.join(dict.fromkeys(('derivative', *PLAIN, *OVER_TIME, *OF_CURVES)))}"
        )
    least, maximum, _ = PLAIN[name]
    if not least <= len(given) <= maximum:
        raise ValueError(f"{name} takes {least if least == maximum else f'{least} or more'}, not {len(given)}")


def _reach_back(tree: Tree) -> tuple[float, int]:
    """How far back a value depends on its arguments: the seconds and the samples before its own."""
    parts = [_reach_back(each) for each in children(tree)]
    seconds, samples = max((each[0] for each in parts), default=0.0), max((each[1] for each in parts), default=0)
    if isinstance(tree, Call):
        if tree.function == "derivative":
            samples += 1
        elif tree.function == "integral":
            seconds = np.inf
        elif tree.function == "despike":
            samples += NEIGHBOURS_PER_SIDE
        elif tree.arguments and isinstance(span := tree.arguments[-1], Span):
            seconds += span.seconds
    return seconds, samples


def _evaluate(tree: Tree, times: Array, known: Mapping[str, HeldValues]) -> Array:
    if isinstance(tree, Number):
        return np.full(len(times), float(tree.value))
    if isinstance(tree, Name):
        return np.full(len(times), float(CONSTANTS[tree.text]))
    if isinstance(tree, Path):
        return held_values(known[tree.text], times)
    if isinstance(tree, Negation):
        return -_evaluate(tree.of, times, known)
    if isinstance(tree, BinaryOperation):
        both = (_evaluate(tree.left, times, known), _evaluate(tree.right, times, known))
        return OPERATORS[tree.operator](*both)
    if isinstance(tree, Call):
        return _evaluate_call(tree, times, known)
    raise TypeError(f"{tree} has no value")  # a span, which `parse_formula` refuses


def _evaluate_call(call: Call, times: Array, known: Mapping[str, HeldValues]) -> Array:
    given = call.arguments
    if isinstance(span := given[-1], Span):
        return OVER_TIME[call.function](times, _evaluate(given[0], times, known), span.seconds)
    parts: Sequence[Array] = [_evaluate(each, times, known) for each in given]
    if call.function in OF_CURVES:
        return OF_CURVES[call.function](times, parts[0])
    function: Callable[..., Array] = PLAIN[call.function][2]
    return function(*parts)


def held_values(path: HeldValues, times: Array) -> Array:
    """The last value of a path at each of these times; NaN before its first."""
    at = np.searchsorted(path.times, times, side="right") - 1
    if not len(path.values):
        return np.full(len(times), np.nan)
    return np.where(at >= 0, path.values[np.maximum(at, 0)], np.nan)
