"""Suggestions for what to plot, given what has been typed so far: matching paths, and expressions."""

from __future__ import annotations

import re
from collections.abc import Sequence

from bot_console.tui.panes.plot.formulas.formula import Formula, parse_formula
from bot_console.tui.text.expression.tree import is_parameter
from bot_console.tui.widgets.prompt.question import Option
from textual.fuzzy import Matcher

MAX_SUGGESTIONS = 200
"""Maximum number of options; typing more narrows them."""

PATH = re.compile(r"(/\w+)+(/|:)\w[\w.\[\]]*")
LAST_PATH = re.compile(r"(.*[-+*/%(,]\s*)(/[^\s()+*%,-]*)")


def suggestions(known: Sequence[str], typed: str) -> list[Option]:
    """The options for a typed text, best first. `known` lists fields before array elements and functions of arrays."""
    text = typed.strip()
    if not text:
        return [Option(each, _about(each)) for each in known[:MAX_SUGGESTIONS]]
    if text in known:
        return [
            Option(text, _about(text)),
            *(Option(each, _about(each)) for each in _best(known, text) if each != text),
        ]
    opened = LAST_PATH.fullmatch(text)
    if opened and opened[2] not in known:
        close = ")" * (opened[1].count("(") - opened[1].count(")"))
        completed = [Option(f"{opened[1]}{each}{close}") for each in _best(known, opened[2])]
        return [*completed, *_as_typed(text, completed)]
    found = [Option(each, _about(each)) for each in _best(known, text)]
    return [*_as_typed(text, found), *found, *_missing_path(text, found)]


def _as_typed(text: str, found: Sequence[Option]) -> list[Option]:
    """The text itself as an option, if it is an expression or no known path matches it."""
    try:
        formula = parse_formula(text)
    except ValueError as error:
        return [] if found else [Option(text, f"✗ {error}")]
    if isinstance(formula, Formula):
        return [Option(text, "expression")]
    return [] if found else [Option(text)]


def _missing_path(text: str, found: Sequence[Option]) -> list[Option]:
    """The typed path as an option even if it does not exist yet, after known paths that only match it loosely."""
    if not found or any(text in each.title for each in found) or not PATH.fullmatch(text):
        return []
    return [Option(text, "does not exist yet")]


def _best(known: Sequence[str], typed: str) -> list[str]:
    characters = set(typed.lower()) - {" "}
    some = [each for each in known if characters <= set(each.lower())]
    matcher = Matcher(typed)
    scores = {each: matcher.match(each) for each in some}
    places = {each: place for place, each in enumerate(some)}
    best = sorted(
        (each for each in some if scores[each] > 0), key=lambda each: (_rank(each), -scores[each], places[each])
    )
    return best[:MAX_SUGGESTIONS]


def _rank(path: str) -> int:
    """Sort key: scalar fields first, then elements of arrays, then functions of whole arrays."""
    return 2 if path.endswith("()") else int(path.endswith("]"))


def _about(path: str) -> str:
    if is_parameter(path):
        return "parameter"
    return ("", "or another element by its index", "of the whole array")[_rank(path)]
