"""Parses expressions: numbers, names, paths, `+ - * / // % **`, brackets and calls, with Python's precedence."""

from __future__ import annotations

import re
from typing import NoReturn

from bot_console.tui.text.expression.tree import (
    OF_ARRAYS,
    RATE,
    BinaryOperation,
    Call,
    Name,
    Negation,
    Number,
    Path,
    Span,
    Tree,
    rate_path,
)
from bot_console.tui.text.sanitize import cut

MAX_CHARACTERS = 400
"""The maximum length of an expression."""
MAX_DEPTH = 40
"""The maximum nesting of brackets, signs and powers, so that no input exhausts the stack."""

TIME_UNITS_S = {"s": 1.0, "ms": 0.001, "min": 60.0}
"""Units of a length of time."""

NUMBER = re.compile(r"0[xX][0-9a-fA-F_]+|0[bB][01_]+|0[oO][0-7_]+|(?:\d[\d_]*\.?[\d_]*|\.\d[\d_]*)(?:[eE][+-]?\d+)?")
NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
PATH = re.compile(
    r"(?:/[A-Za-z_]\w*)+(?:[./][A-Za-z_]\w*(?!\w*\()|\[-?\d*(?::-?\d*)?\])*"
    rf"(?:\.(?:{'|'.join(OF_ARRAYS)})\(\)|:[A-Za-z_]\w*(?:[./][A-Za-z_]\w*)*)?",
    re.ASCII,
)
TOPIC = re.compile(r"(?:/[A-Za-z_]\w*)+", re.ASCII)
OPERATOR = re.compile(r"\*\*|//|[-+*/%]")
_RANKS = {"+": 1, "-": 1, "*": 2, "/": 2, "//": 2, "%": 2}


def parse(text: str, *, paths: bool = False) -> Tree:
    """Parse an expression; raises `ValueError` that says what is wrong and where. `paths` allows topics and
    parameters.
    """
    if len(text) > MAX_CHARACTERS:
        raise ValueError(f"an expression of more than {MAX_CHARACTERS} characters")
    return Reader(text, paths).whole()


class Incomplete(ValueError):
    """The text ends before the expression is complete."""


class Reader:
    """Parses an expression from left to right; a subclass can parse what surrounds expressions."""

    def __init__(self, text: str, paths: bool) -> None:
        self._text = text
        self._paths = paths
        self._at = 0
        self._depth = 0

    def whole(self) -> Tree:
        """The tree of the whole text."""
        tree = self.sum(1)
        if self.rest():
            self.fail("an operator is expected")
        return tree

    def rest(self) -> str:
        """The text not parsed yet."""
        while self._text[self._at : self._at + 1] in (" ", "\t"):
            self._at += 1
        return self._text[self._at :]

    def take(self, pattern: re.Pattern[str]) -> str:
        """Consume and return what matches a pattern here; empty if nothing does."""
        self.rest()
        found = pattern.match(self._text, self._at)
        if found is None:
            return ""
        self._at = found.end()
        return found[0]

    def fail(self, why: str) -> NoReturn:
        """Raise `ValueError` with the reason and the position; `Incomplete` at the end of the text."""
        if rest := self.rest():
            raise ValueError(f"{why} at '{cut(rest, 20)}'")
        raise Incomplete(why if self._text.strip() else f"{why}, but nothing was typed")

    def sum(self, least: int = 1) -> Tree:
        """Parse operators that bind at least as closely as `+` (1) or `*` (2)."""
        left = self._sign()
        while True:
            begin = self._at
            operator = self.take(OPERATOR)
            if _RANKS.get(operator, 0) < least:
                self._at = begin
                return left
            left = BinaryOperation(operator, left, self.sum(_RANKS[operator] + 1))

    def _sign(self) -> Tree:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise ValueError(f"more than {MAX_DEPTH} brackets or signs within each other")
        sign = self.rest()[:1]
        if sign in ("+", "-"):
            self._at += 1
            tree: Tree = self._sign()
            tree = Negation(tree) if sign == "-" else tree
        else:
            tree = self._power()
        self._depth -= 1
        return tree

    def _power(self) -> Tree:
        base = self._atom()
        if self.rest().startswith("**"):
            self._at += 2
            return BinaryOperation("**", base, self._sign())
        return base

    def _atom(self) -> Tree:
        if self.rest().startswith("("):
            self._at += 1
            tree = self.sum(1)
            self._close()
            return tree
        if self._paths and (path := self.take(PATH)):
            return Path(path)
        if number := self.take(NUMBER):
            return self._number(number)
        if name := self.take(NAME):
            return self._call(name) if self.rest().startswith("(") else Name(name)
        before = re.search(rf"(?:{OPERATOR.pattern}|[<>=!]=?|[(,])$", self._text[: self._at].rstrip())
        what = "a number or a path" if self._paths else "a number"
        self.fail(f"{what} must follow {before[0]}" if before else f"{what} is expected")

    def _number(self, text: str) -> Tree:
        try:
            value = float(text) if re.search(r"[.eE]", text) and text[:2] not in ("0x", "0X") else int(text, 0)
            float(value)
        except ValueError:
            raise ValueError(f"'{cut(text, 20)}' is not a number") from None
        except OverflowError:
            raise ValueError(f"'{cut(text, 20)}' is too large") from None
        begin = self._at
        unit = self.take(NAME) if self._paths else ""
        if unit in TIME_UNITS_S:
            return Span(float(value) * TIME_UNITS_S[unit])
        self._at = begin
        return Number(value)

    def _call(self, function: str) -> Tree:
        self._at += 1
        arguments: list[Tree] = []
        while not self.rest().startswith(")"):
            if arguments and not self._comma():
                self.fail("a comma or a closing bracket is expected")
            arguments.append(self.sum(1))
        self._close()
        if function in OF_ARRAYS and len(arguments) == 1 and isinstance(one := arguments[0], Path):
            return Path(f"{one.text}.{function}()")
        if function == RATE and self._paths:
            return self._rate(arguments)
        return Call(function, tuple(arguments))

    def _rate(self, arguments: list[Tree]) -> Path:
        if len(arguments) != 1 or not isinstance(one := arguments[0], Path) or not TOPIC.fullmatch(one.text):
            raise ValueError(f"{RATE} takes the name of a topic, such as {RATE}(/scan)")
        return Path(rate_path(one.text))

    def _comma(self) -> bool:
        found = self.rest().startswith(",")
        self._at += found
        return found

    def _close(self) -> None:
        if not self.rest().startswith(")"):
            self.fail("a closing bracket is missing")
        self._at += 1
