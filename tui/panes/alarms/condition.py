"""Conditions over topics and parameters, such as `/battery/percentage < 0.2 and /odom/twist.twist.linear.x > 1`. Pure.

condition  = comparison {and|or comparison}, `and` before `or`
comparison = expression with < <= > >= == != between two or more of them
expression = what `tui.text.expression` takes, with paths where it has names; `true` and `false` are 1 and 0
"""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.format import cut
from bot_console.tui.text.expression.numbers import evaluate
from bot_console.tui.text.expression.parse import PATH

LONGEST = 400
"""Letters of a condition at most."""
COMPARISON = re.compile(r"<=|>=|==|!=|<|>")
OPERATORS: Mapping[str, Callable[[float, float], bool]] = {
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
}  # fmt: skip
WORDS = {"true": 1, "false": 0}


@dataclass(frozen=True)
class Comparison:
    """Expressions with comparisons between them, all of which must hold."""

    sides: tuple[str, ...]
    operators: tuple[str, ...]

    def holds(self, values: Mapping[str, float]) -> bool:
        """Whether it holds for these values of the names; raises `ValueError` for what cannot be worked out."""
        found = [evaluate(each, values) for each in self.sides]
        return all(
            OPERATORS[sign](left, right) for sign, left, right in zip(self.operators, found, found[1:], strict=False)
        )


@dataclass(frozen=True)
class Condition:
    """A condition that was read: its paths by the names they have in it, and its alternatives."""

    text: str
    paths: Mapping[str, str]
    """Path for each name."""
    alternatives: tuple[tuple[Comparison, ...], ...]

    def holds(self, values: Mapping[str, float]) -> bool:
        """Whether it holds for the values of its paths; raises `ValueError` for what cannot be worked out."""
        named = {**WORDS, **{name: values[path] for name, path in self.paths.items()}}
        return any(all(each.holds(named) for each in every) for every in self.alternatives)


def read(text: str) -> Condition:
    """Read a condition; raises `ValueError` with what is wrong and how it should be."""
    if len(text) > LONGEST:
        raise ValueError(f"a condition of more than {LONGEST} letters")
    plain, paths = _without_paths(text)
    if not paths:
        raise ValueError("name a field or a parameter in it, for instance /battery/percentage < 0.2")
    alternatives = tuple(
        tuple(_comparison(each) for each in re.split(r"\band\b", every)) for every in re.split(r"\bor\b", plain)
    )
    condition = Condition(" ".join(text.split()), paths, alternatives)
    _try(condition)
    return condition


def _without_paths(text: str) -> tuple[str, dict[str, str]]:
    """The text with a name in the place of each path, and the paths by name.

    A slash behind a number, a name or a bracket divides; any other begins a path.
    """
    names: dict[str, str] = {}
    parts: list[str] = []
    at = 0
    while at < len(text):
        before = "".join(parts).rstrip()
        divides = before[-1:].isalnum() or before[-1:] in ("_", ")", "]")
        divides = divides and not re.search(r"\b(?:and|or)$", before)
        found = None if divides else PATH.match(text, at)
        if found:
            path = found[0]
            name = next((each for each, known in names.items() if known == path), f"path{len(names)}")
            names[name] = path
            parts.append(name)
            at = found.end()
        else:
            parts.append(text[at])
            at += 1
    return "".join(parts), names


def _comparison(text: str) -> Comparison:
    sides, operators = tuple(COMPARISON.split(text)), tuple(COMPARISON.findall(text))
    if not text.strip():
        raise ValueError("a comparison is missing before or behind 'and', 'or'")
    if not operators:
        raise ValueError(f"'{cut(text.strip(), 24)}' compares nothing; write for instance ... < 0.2")
    if any(not each.strip() for each in sides):
        raise ValueError("a side of a comparison is missing")
    return Comparison(sides, operators)


def _try(condition: Condition) -> None:
    """Find what is wrong with the expressions before there are values: whatever the values, the grammar is the same."""
    for value in (1.0, 0.5):
        named = {**WORDS, **dict.fromkeys(condition.paths, value)}
        for each in (one for every in condition.alternatives for one in every):
            for side in each.sides:
                _grammar(side, named)


def _grammar(side: str, named: Mapping[str, float]) -> None:
    try:
        evaluate(side, named)
    except ValueError as error:
        if not any(words in str(error) for words in ("division by zero", "worked out", "negative")):
            raise ValueError(re.sub(r"path\d+", "the path", str(error))) from None


def newest(values: Mapping[str, Sequence[float]]) -> dict[str, float]:
    """The last value of each path that has one which is a number."""
    return {path: each[-1] for path, each in values.items() if len(each) and math.isfinite(each[-1])}
