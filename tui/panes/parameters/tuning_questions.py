"""The questions before a tuning begins: ranges, score, number of runs. Pure, apart from asking."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree
from bot_console.tui.tuning.score import BUILT_IN_SCORES, FIGURES, STATISTICS, parse_score
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Tunable, find_tunables
from bot_console.tui.widgets.prompt.question import Option

KINDS = {Kind.BOOL: "bool", Kind.INTEGER: "integer", Kind.DOUBLE: "double"}
MAX_COMPLETIONS = 50
"""Maximum number of completions offered."""


def tunable_of(parameter: ParameterInfo) -> Tunable | None:
    """The tunable for a parameter; None if it is not a number or boolean, or cannot be set."""
    kind, value = KINDS.get(parameter.kind), parameter.value
    if kind is None or parameter.read_only or not isinstance(value, (bool, int, float)):
        return None
    low, high = (parameter.range.low, parameter.range.high) if parameter.range else (-math.inf, math.inf)
    if kind == "bool":
        low, high = 0, 1
    return Tunable(parameter.node, parameter.name, kind, low, high, value, parameter.unit, parameter.range)


def ranges_text(tunables: Sequence[Tunable]) -> str:
    """Tunables as the user would type them, with their ranges if they have one."""
    return " ".join(
        each.label
        if each.kind == "bool" or not math.isfinite(each.low)
        else f"{each.label}={each.low:g}..{each.high:g}"
        for each in tunables
    )


def ranges_problem(known: Sequence[Tunable], text: str) -> str:
    """The problem with typed ranges; empty if there is none."""
    try:
        find_tunables(text.split(), [*known])
    except ValueError as error:
        return str(error)
    return ""


def scores(plottable: Sequence[str], typed: str) -> list[Option]:
    """The options for a typed score: predefined scores, the text itself if it is a formula, and completions."""
    found = [
        Option(name, f"{what}: {formula}")
        for name, (formula, what) in BUILT_IN_SCORES.items()
        if typed.lower() in name or not typed
    ]
    if typed.strip():
        try:
            parse_score(typed)
            found.insert(0, Option(typed, "this formula"))
        except ValueError as error:
            found += [*_completions(plottable, typed)[:MAX_COMPLETIONS]] or [Option(typed, f"✗ {error}")]
    return found


def _completions(plottable: Sequence[str], typed: str) -> list[Option]:
    """The formula with its last word completed: a topic's field, a figure, or a statistic."""
    at = max(typed.rfind(each) for each in " (+-*,") + 1
    before, begun = typed[:at], typed[at:]
    if begun.startswith("/"):
        paths = [each for each in plottable if each.startswith(begun) and ":" not in each]
        return [Option(f"{before}{each}" + ")" * (before.count("(") - before.count(")")), "") for each in paths]
    figures = [Option(before + name, what) for name, what in FIGURES.items() if begun and name.startswith(begun)]
    return figures + [
        Option(f"{before}{name}(/", "of a topic's field") for name in STATISTICS if begun and name.startswith(begun)
    ]


def numbers(text: str) -> tuple[int, float]:
    """Parse the number of runs and the simulated seconds of each, such as `60 30`; raises `ValueError`."""
    words = text.split()
    try:
        runs, seconds = int(words[0]), float(words[1]) if len(words) > 1 else 60.0
        if len(words) <= 2 and runs > 0 and 0 < seconds < math.inf:
            return runs, seconds
    except (ValueError, IndexError):
        pass
    raise ValueError("two numbers: runs, and simulated seconds of each, such as 60 60")


def specification_of(
    tunables: Sequence[Tunable], score: str, text: str, trees: Mapping[str, ParameterTree]
) -> TuningSpecification:
    """The tuning specification, based on the values of the running system; raises `ValueError`."""
    runs, seconds = numbers(text)
    return TuningSpecification(
        tuple(tunables), parse_score(score), runs=runs, duration=seconds, base=running_values(trees)
    )


def running_values(trees: Mapping[str, ParameterTree]) -> dict[str, dict[str, Any]]:
    """The values of the running system's nodes, as far as a simulated run can be started with them."""
    values: dict[str, dict[str, Any]] = {}
    for tree in trees.values():
        for each in tree.parameters if "/_" not in tree.node else ():
            if isinstance(each.value, (bool, int, float, str)) and not each.read_only and each.name != "use_sim_time":
                values.setdefault(tree.node, {})[each.name] = each.value
    return values
