"""Expressions over curves compared with a model that computes each value separately, following the documentation."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from bot_console.tui.panes.plot.formulas.formula import HeldValues, parse_formula
from hypothesis import given
from hypothesis import strategies as st

Samples = list[tuple[float, float]]

series = st.lists(
    st.tuples(st.integers(1, 40), st.one_of(st.integers(-9, 9).map(float), st.just(math.nan))), max_size=25
).map(lambda steps: [(sum(gap for gap, _ in steps[: at + 1]) / 8, value) for at, (_, value) in enumerate(steps)])

expressions = st.recursive(
    st.sampled_from(["/a/x", "/b/x", "/n:gain", "2", "0.5", "pi"]),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["+", "-", "*", "/"]), inner).map(lambda of: f"({of[0]} {of[1]} {of[2]})"),
        st.tuples(st.sampled_from(["abs", "deg", "derivative", "-"]), inner).map(lambda of: f"{of[0]}({of[1]})"),
        st.tuples(st.sampled_from(["min", "max", "hypot"]), inner, inner).map(lambda of: f"{of[0]}({of[1]}, {of[2]})"),
        st.tuples(st.sampled_from(["mean", "min", "max"]), inner, st.sampled_from(["1 s", "250 ms", "3 s"])).map(
            lambda of: f"{of[0]}({of[1]}, {of[2]})"
        ),
    ),
    max_leaves=5,
)

ONE: dict[str, Callable[[float], float]] = {"abs": abs, "deg": math.degrees, "-": lambda value: -value}
SECONDS = {"1 s": 1.0, "250 ms": 0.25, "3 s": 3.0}


class Model:
    """Evaluates an expression of the shapes above at one sample after the other."""

    def __init__(self, known: dict[str, Samples], times: list[float]) -> None:
        self._known = known
        self._times = times

    def values(self, text: str) -> list[float]:
        if text in self._known:
            return [self._held(text, time) for time in self._times]
        if text in ("2", "0.5", "pi"):
            return [{"pi": math.pi}.get(text) or float(text) for _ in self._times]
        function, _, rest = text.partition("(")
        parts = self._split(rest[:-1])
        if parts[-1] in SECONDS:
            return self._over(function, self.values(parts[0]), SECONDS[parts[-1]])
        if function == "derivative":
            return self._slope(self.values(parts[0]))
        if function in ONE:
            return [ONE[function](value) for value in self.values(parts[0])]
        two = list(zip(self.values(parts[0]), self.values(parts[-1]), strict=True))
        return [self._both(function or parts[1], *each) for each in two]

    def _held(self, path: str, time: float) -> float:
        return next((value for at, value in reversed(self._known[path]) if at <= time), math.nan)

    def _over(self, function: str, values: list[float], seconds: float) -> list[float]:
        found = []
        for now in self._times:
            last = [
                value
                for at, value in zip(self._times, values, strict=True)
                if now - seconds < at <= now and not math.isnan(value) and (function != "mean" or math.isfinite(value))
            ]
            make = {"min": min, "max": max, "mean": lambda given: sum(given) / len(given)}[function]
            found.append(make(last) if last else math.nan)
        return found

    def _slope(self, values: list[float]) -> list[float]:
        pairs = zip(self._times, self._times[1:], values, values[1:], strict=False)
        slopes = [math.nan, *((after - before) / (end - begin) for begin, end, before, after in pairs)]
        return slopes[: len(values)]

    @staticmethod
    def _both(operator: str, left: float, right: float) -> float:
        if math.isnan(left) or math.isnan(right):
            return math.nan
        if operator == "/":
            return float(np.divide(np.float64(left), np.float64(right)))
        made: dict[str, Callable[[], float]] = {
            "+": lambda: left + right, "-": lambda: left - right, "*": lambda: left * right,
            "min": lambda: min(left, right), "max": lambda: max(left, right), "hypot": lambda: math.hypot(left, right),
        }  # fmt: skip
        return made[operator]()

    @staticmethod
    def _split(text: str) -> list[str]:
        """Split a text at commas, or at an operator, outside all brackets."""
        depths = [text[: at + 1].count("(") - text[: at + 1].count(")") for at in range(len(text))]
        commas = [at for at, character in enumerate(text) if character == "," and depths[at] == 0]
        if commas:
            return [text[: commas[0]], text[commas[0] + 2 :]]
        blanks = [at for at, character in enumerate(text) if character == " " and depths[at] == 0]
        if len(blanks) == 2:
            return [text[: blanks[0]], text[blanks[0] + 1], text[blanks[1] + 1 :]]
        return [text]


@given(expressions, series, series, series, st.floats(0, 20), st.floats(0, 20))
def test_every_value_follows_the_documentation(
    text: str, a: Samples, b: Samples, gain: Samples, start: float, length: float
) -> None:
    try:
        formula = parse_formula(text)
    except ValueError:
        assert "/" not in text.replace(" / ", ""), "only expressions without a path are refused"
        return
    if isinstance(formula, str):
        return
    known = {"/a/x": a, "/b/x": b, "/n:gain": gain}
    held = {
        path: HeldValues(np.array([each[0] for each in of], float), np.array([each[1] for each in of], float))
        for path, of in known.items()
    }
    lead = formula.lead
    times = [at for at, _ in known[lead]] if lead else sorted({at for path in formula.paths for at, _ in known[path]})
    with np.errstate(all="ignore"):
        wanted = Model(known, times).values(text)
    found_times, found = formula.values(held)
    assert found_times.tolist() == times
    assert found.tolist() == pytest.approx(wanted, nan_ok=True, rel=1e-6, abs=1e-6)
    some_times, some = formula.values(held, start, start + length)
    inside = [at for at, time in enumerate(times) if start <= time <= start + length]
    shown = {time: value for time, value in zip(some_times.tolist(), some.tolist(), strict=True)}
    assert [shown[times[at]] for at in inside] == pytest.approx(
        [wanted[at] for at in inside], nan_ok=True, rel=1e-6, abs=1e-6
    ), "a part of the samples must give the same values as all of them"
