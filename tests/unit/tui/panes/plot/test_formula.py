"""Expressions over paths: which are accepted, which are refused and why, and which samples they need."""

from __future__ import annotations

import numpy as np
import pytest
from bot_console.tui.panes.plot.formulas.formula import Formula, HeldValues, parse_formula, split_expressions
from bot_console.tui.panes.plot.time_window import Timeline
from fakes.console import FakeConsole

A, B = "/a/x", "/b/pose.position.y[0]"


def values(text: str) -> list[float]:
    formula = parse_formula(text)
    assert isinstance(formula, Formula)
    times = np.arange(4.0)
    held = {A: HeldValues(times, np.array([1.0, 2.0, 4.0, 8.0])), B: HeldValues(times, np.array([3.0, 3.0, 3.0, 4.0]))}
    return formula.values({**held, "/n:gain.k": HeldValues(np.array([1.5]), np.array([10.0]), steps=True)})[1].tolist()


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (f"{A} - {B}", [-2, -1, 1, 4]),
        (f"{A}-{B}*2", [-5, -4, -2, 0]),
        (f"-{A}**2", [-1, -4, -16, -64]),
        (f"2 / {A} / 2", [1, 0.5, 0.25, 0.125]),
        (f"{A} // 3 + {A} % 3", [1, 2, 2, 4]),
        (f"derivative({A})", [np.nan, 1, 2, 4]),
        (f"integral({A})", [0, 1.5, 4.5, 10.5]),
        (f"integral(derivative({A}))", [0, 0, 1.5, 4.5]),
        (f"rms({A}, 1.5 s)", [1, np.sqrt(2.5), np.sqrt(10), np.sqrt(40)]),
        (f"despike({B})", [3, 3, 3, 3]),
        (f"mean({A}, 2 s)", [1, 1.5, 3, 6]),
        (f"max({B}, 1500 ms) - min({A}, 0.1 min)", [2, 2, 2, 3]),
        (f"{A} * /n:gain.k", [np.nan, np.nan, 40, 80]),
        (f"hypot({A}, 0) + max({A}, {B}, 5)", [6, 7, 9, 16]),
        (f"std({A}, 1.5 s)", [0, 0.5, 1, 2]),
        (f"round(wrap(rad({A} * 100)) * 100)", [175, -279, 70, 140]),
    ],
)
def test_expression_is_evaluated_over_samples(text: str, wanted: list[float]) -> None:
    assert values(text) == pytest.approx(wanted, nan_ok=True)


@pytest.mark.parametrize(
    ("text", "path"),
    [
        ("min(/scan/ranges)", "/scan/ranges.min()"),
        ("/scan/ranges[10:20].mean()", "/scan/ranges[10:20].mean()"),
        (" yaw(/odom/pose.pose.orientation) ", "/odom/pose.pose.orientation.yaw()"),
        ("/n:a.b", "/n:a.b"),
    ],
)
def test_function_of_one_message_becomes_a_path(text: str, path: str) -> None:
    assert parse_formula(text) == path


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("2 + 3", "name a path"), ("/a/x +", r"a number or a path must follow \+"),
        ("/a/x 2", "operator"), ("(/a/x", "bracket is missing"),
        ("speed + /a/x", "not a path; paths begin with /"), ("sine(/a/x)", "not one of derivative, abs"),
        ("mean(/a/x + 1)", r"write mean\(a path, 1 s\)"), ("mean(1 s, /a/x)", "comes last"),
        ("atan2(/a/x)", "takes 2"),
        ("/a/x + 1 s", "only be the last argument"), ("derivative(/a/x, 1 s)", "takes no time span"),
        ("mean(/a/x, 0 s)", "longer than 0"), ("__import__('os')", "at ''os'"), ("/a/x.__class__()", "operator"),
        ("(" * 50 + "/a/x", "within each other"), ("/a/x+" * 90 + "1", "400 characters"), ("", "nothing was typed"),
        ("/a/x ^ 2", "operator"), ("lambda: /a/x", "operator"), ("hypot(/a/x,", "a number or a path must follow ,"),
        ("/a/x + abs()", "takes 1"), (f"/a/x + 0x{'f' * 300}", "too large"),
    ],
)  # fmt: skip
def test_invalid_expression_is_rejected_with_a_reason(text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        parse_formula(text)


def test_colon_of_a_slice_is_not_taken_for_a_parameter() -> None:
    formula = parse_formula("min(/scan/ranges[80:100]) * /n:gain.k")
    assert isinstance(formula, Formula) and formula.lead == "/scan/ranges[80:100].min()"


def test_commas_in_brackets_do_not_separate_paths() -> None:
    assert split_expressions("/a/x, max(/a/x, /b/y) , /s/r[1:2],") == ["/a/x", "max(/a/x, /b/y)", "/s/r[1:2]"]


def detach(console: FakeConsole) -> list[str]:
    return [each[1] for each in console.asked if each[0] == "unwatch"]


def test_shared_paths_are_released_with_their_last_curve() -> None:
    console = FakeConsole()
    console.series |= {A: ([1.0, 2.0], [1.0, 2.0]), "/c/y": ([0.5, 1.5], [10.0, 20.0]), "/c/z": ([], [])}
    timeline = Timeline(console.plots)
    assert timeline.add(f"{A} + /c/y").ok and timeline.add(A).ok
    assert [each[1] for each in console.asked] == [A, "/c/y"], "each is watched once"
    assert timeline.fetch_samples()
    assert timeline.curves[0].latest == 22.0 and timeline.curves[1].latest == 2.0
    assert not timeline.fetch_samples()
    refused = timeline.add(f"{A} - /no/topic")
    assert not refused.ok and "/no/topic" in refused.text and len(timeline.curves) == 2
    assert detach(console) == [], "paths that another curve needs are still watched"
    assert not timeline.add("/c/z + /no/topic").ok
    assert detach(console) == ["/c/z"], "paths of a curve that cannot be made are released"
    timeline.remove(0)
    assert detach(console) == ["/c/z", "/c/y"]
    timeline.remove(0)
    assert detach(console) == ["/c/z", "/c/y", A]
    wrong = timeline.add("sine(/a/x)")
    assert not wrong.ok and "not one of" in wrong.text


def test_samples_are_placed_by_header_stamps_on_request() -> None:
    from bot_console.tui.panes.plot.curves import Curve

    curve = Curve("/a/x", 0, np.array([1.0, 2.0, 3.0]), np.array([7.0, 8.0, 9.0]))
    curve.headers = np.array([0.9, np.nan, 0.4])
    assert curve.samples()[0].tolist() == [1.0, 2.0, 3.0]
    curve.by_header = True
    assert [each.tolist() for each in curve.samples()] == [[0.4, 0.9, 2.0], [9.0, 7.0, 8.0]]
    assert curve.at(1.0) == 7.0 and curve.at(0.1) is None and curve.end == 2.0


def curve(text: str, given: list[float], start: float, end: float) -> list[float]:
    formula = parse_formula(text)
    assert isinstance(formula, Formula)
    return formula.values({A: HeldValues(np.arange(float(len(given))), np.array(given))}, start, end)[1].tolist()


def test_outliers_are_replaced_and_steps_and_gaps_stay() -> None:
    noisy = [1.0, 1.1, 0.9, 1.0, 50.0, 1.1, 1.0, 0.9, 1.0, 1.1]
    assert max(curve(f"despike({A})", noisy, 0, 9)) == 1.1
    step = [1.0] * 6 + [2.0] * 6
    assert curve(f"despike({A})", step, 0, 11) == step
    gap = [1.0, 1.0, np.nan, 1.0, 1.0]
    assert np.isnan(curve(f"despike({A})", gap, 0, 4)[2])
    assert curve(f"despike({A})", [1.0, 9.0], 0, 1) == [1.0, 9.0]


@pytest.mark.parametrize("text", [f"integral({A})", f"despike({A})", f"derivative({A})", f"rms({A}, 3 s)"])
def test_part_of_a_curve_is_the_same_as_in_the_whole(text: str) -> None:
    given = [float(each * each % 7) for each in range(30)]
    whole = curve(text, given, -np.inf, np.inf)
    assert curve(text, given, 12, 20) == pytest.approx(whole[11:22])
