"""Conditions over topics and parameters, such as `/battery/percentage < 0.2 and /odom/twist.twist.linear.x > 1`. Pure.

condition  = comparison {and|or comparison}, `and` before `or`
comparison = two or more expressions with < <= > >= == != between them
expression = an expression of `tui.text.expression` over paths; `true` and `false` are 1 and 0
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from bot_console.tui.text.expression.numbers import value_of
from bot_console.tui.text.expression.parse import Reader
from bot_console.tui.text.expression.tree import Span, Tree, paths_of, walk
from bot_console.tui.text.sanitize import cut

MAX_CHARACTERS = 400
"""Maximum characters of a condition."""
NOTHING_NAMED = "name a field or a parameter, for instance /battery/percentage < 0.2"
COMPARISON = re.compile(r"<=|>=|==|!=|<|>")
OPERATORS: Mapping[str, Callable[[float, float], bool]] = {
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
}  # fmt: skip
WORDS = {"true": 1, "false": 0}
AND, OR, EITHER = re.compile(r"and\b"), re.compile(r"or\b"), re.compile(r"(?:and|or)\b")


@dataclass(frozen=True)
class Comparison:
    """Two or more expressions with comparison operators between them, all of which must hold."""

    sides: tuple[Tree, ...]
    operators: tuple[str, ...]

    def holds(self, known: Mapping[str, float]) -> bool:
        """Whether it holds for these values; raises `ValueError` if it cannot be evaluated."""
        found = [value_of(each, known) for each in self.sides]
        return all(
            OPERATORS[sign](left, right) for sign, left, right in zip(self.operators, found, found[1:], strict=False)
        )


@dataclass(frozen=True)
class Condition:
    """A parsed condition: its paths and its alternatives."""

    text: str
    paths: tuple[str, ...]
    alternatives: tuple[tuple[Comparison, ...], ...]

    def holds(self, values: Mapping[str, float]) -> bool:
        """Whether it holds for the values of its paths; raises `ValueError` if it cannot be evaluated."""
        known = {**WORDS, **values}
        return any(all(each.holds(known) for each in every) for every in self.alternatives)

    def compared(self, values: Mapping[str, float]) -> float | None:
        """The left side of the first comparison, such as the minimum range of a scan; None while it is unknown."""
        try:
            return float(value_of(self.alternatives[0][0].sides[0], {**WORDS, **values}))
        except ValueError:
            return None


def parse_condition(text: str) -> Condition:
    """Parse a condition; raises `ValueError` that says what is wrong and how to fix it."""
    if len(text) > MAX_CHARACTERS:
        raise ValueError(f"the condition is longer than {MAX_CHARACTERS} characters")
    if not text.strip():
        raise ValueError(NOTHING_NAMED)
    alternatives = _ConditionReader(text, paths=True).alternatives()
    sides = [side for every in alternatives for each in every for side in each.sides]
    paths = tuple(dict.fromkeys(path for side in sides for path in paths_of(side)))
    if not paths:
        raise ValueError(NOTHING_NAMED)
    for side in sides:
        _check(side, paths)
    return Condition(" ".join(text.split()), paths, alternatives)


class _ConditionReader(Reader):
    """Parses comparisons of expressions, combined by `and` and `or`."""

    def alternatives(self) -> tuple[tuple[Comparison, ...], ...]:
        found = [self._every()]
        while self.take(OR):
            found.append(self._every())
        if self.rest():
            self.fail("a comparison, 'and', 'or' or an operator is expected")
        return tuple(found)

    def _every(self) -> tuple[Comparison, ...]:
        found = [self._comparison()]
        while self.take(AND):
            found.append(self._comparison())
        return tuple(found)

    def _comparison(self) -> Comparison:
        begin = self.rest()
        if not begin or EITHER.match(begin):
            raise ValueError("a comparison is missing before or after 'and' or 'or'; write for instance /a/x < 0.2")
        sides, operators = [self._side()], list[str]()
        while sign := self.take(COMPARISON):
            operators.append(sign)
            sides.append(self._side())
        if not operators and (not self.rest() or EITHER.match(self.rest())):
            what = begin.removesuffix(self.rest()).strip()
            raise ValueError(f"'{cut(what, 24)}' compares nothing; write for instance ... < 0.2")
        return Comparison(tuple(sides), tuple(operators))

    def _side(self) -> Tree:
        rest = self.rest()
        if not rest or COMPARISON.match(rest) or EITHER.match(rest):
            raise ValueError("a side of a comparison is missing")
        return self.sum()


def _check(side: Tree, paths: tuple[str, ...]) -> None:
    """Evaluate an expression with made-up values, to find the errors that do not depend on the values."""
    if any(isinstance(each, Span) for each in walk(side)):
        raise ValueError("a time span such as 1 s works in plotted curves only; an alarm is evaluated at each message")
    for value in (1.0, 0.5):
        try:
            value_of(side, {**WORDS, **dict.fromkeys(paths, value)})
        except ValueError as error:
            if not any(words in str(error) for words in ("division by zero", "worked out", "negative")):
                raise
