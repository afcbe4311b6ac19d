"""Scores a run by a formula over the figures of its report and over topics; higher is better."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bot_console.tui.text.expression.numbers import Number, evaluate

FIGURES: Mapping[str, str] = {
    "mean_speed": "distance over time (m/s)",
    "distance": "way driven (m)",
    "collisions": "touches, each counted once",
    "min_clearance": "least room around the hull (m)",
    "stops": "times that it came to a stand",
    "longest_standstill": "longest time without driving (s)",
    "duration": "simulated time (s)",
}
"""The names that a formula may use, with their descriptions."""
BUILT_IN_SCORES: Mapping[str, tuple[str, str]] = {
    "swift": (
        "mean_speed - 2*collisions - 5*max(0, 0.15 - min_clearance)",
        "fast, and without touching anything: a collision costs 2 m/s, less than 0.15 m of room costs too",
    ),
    "steady": (
        "mean_speed - 0.1*stops - longest_standstill/duration - 2*collisions",
        "fast without stopping: a stop costs 0.1 m/s, and the longest standstill costs its share of the time",
    ),
    "roomy": (
        "min(1, min_clearance) + 0.2*mean_speed - 2*collisions",
        "room around the hull first, speed second",
    ),
}
"""Built-in scores: formula and purpose."""
STATISTICS = ("mean", "least", "greatest", "last", "rms")
"""Functions of a topic's samples, such as `mean(/odom/twist.twist.linear.x)`."""
FAILED = -math.inf

_TOPIC = re.compile(rf"\b({'|'.join(STATISTICS)})\(\s*(/[^\s()]+)\s*\)")


@dataclass(frozen=True)
class Score:
    """A valid formula."""

    text: str
    """As typed, or the name of a built-in score."""
    formula: str
    """The formula, with `topic0`, `topic1` ... in place of functions of topics."""
    topics: tuple[tuple[str, str], ...] = ()
    """The statistic and path that each of these names stands for."""

    @property
    def paths(self) -> tuple[str, ...]:
        """The paths of topics, each once."""
        return tuple(dict.fromkeys(path for _, path in self.topics))

    def of(self, report: Mapping[str, Any]) -> float:
        """The score of a run's report; raises `ValueError` if the formula has no value for it."""
        names = figures(report)
        samples: Mapping[str, Mapping[str, float]] = report.get("topics") or {}
        for index, (statistic, path) in enumerate(self.topics):
            found = samples.get(path)
            if not found:
                raise ValueError(f"no message arrived on {path}")
            names[f"topic{index}"] = found[statistic]
        value = float(evaluate(self.formula, names))
        if not math.isfinite(value):
            raise ValueError(f"the score is {value}")
        return value


def figures(report: Mapping[str, Any]) -> dict[str, Number]:
    """The figures of a report by name; one that is None, such as the clearance if nothing came near, is infinite."""
    known = {name: report.get(name) for name in FIGURES}
    return {name: math.inf if value is None else value for name, value in known.items()}


def parse_score(text: str) -> Score:
    """A built-in score by its name, or a formula; raises `ValueError` that says what is wrong with it."""
    topics: list[tuple[str, str]] = []

    def take(match: re.Match[str]) -> str:
        topics.append((match[1], match[2]))
        return f"topic{len(topics) - 1}"

    formula = _TOPIC.sub(take, BUILT_IN_SCORES[text][0] if text in BUILT_IN_SCORES else text)
    if text.isidentifier() and text not in BUILT_IN_SCORES and text not in FIGURES:
        scores, names = ", ".join(BUILT_IN_SCORES), ", ".join(FIGURES)
        raise ValueError(f"'{text}' is not a score; choose from {scores}, or use {names} in a formula")
    score = Score(text, formula, tuple(topics))
    trial = {**dict.fromkeys(FIGURES, 1.0), **{f"topic{index}": 1.0 for index in range(len(topics))}}
    try:
        evaluate(formula, trial)
    except ValueError as error:
        # The formula is tried with ones, with which even a valid one may divide by zero: refuse only what can never
        # be valid.
        if "division" not in str(error) and "negative" not in str(error):
            raise
    return score


def statistics(samples: list[float]) -> dict[str, float]:
    """The statistics of a topic's samples; empty if there are none."""
    if not samples:
        return {}
    return {
        "mean": math.fsum(samples) / len(samples),
        "least": min(samples),
        "greatest": max(samples),
        "last": samples[-1],
        "rms": math.sqrt(math.fsum(each * each for each in samples) / len(samples)),
    }
