"""Conditions: their meaning, and refusals with a remedy; nothing typed is ever run."""

from __future__ import annotations

import pytest
from bot_console.tui.panes.alarms.condition import parse_condition
from hypothesis import given
from hypothesis import strategies as st

BATTERY, SPEED = "/battery/percentage", "/odom/twist.twist.linear.x"


@pytest.mark.parametrize(
    ("text", "values", "holds"),
    [
        (f"{BATTERY} < 0.2", {BATTERY: 0.1}, True),
        (f"{BATTERY} < 0.2", {BATTERY: 0.2}, False),
        (f"{BATTERY} < 0.2 and {SPEED} > 1", {BATTERY: 0.1, SPEED: 0.5}, False),
        (f"{BATTERY} < 0.2 or {SPEED} > 1", {BATTERY: 0.1, SPEED: 0.5}, True),
        (f"{SPEED}>1 or {SPEED}<0 and {BATTERY}<0.5", {SPEED: 2.0, BATTERY: 0.9}, True),
        (f"0.1 < {BATTERY} <= 0.2", {BATTERY: 0.2}, True),
        (f"0.1 < {BATTERY} <= 0.2", {BATTERY: 0.1}, False),
        ("/a/x / /b/y >= 2", {"/a/x": 4.0, "/b/y": 2.0}, True),
        ("(/a/x)/2 == 2", {"/a/x": 4.0}, True),
        ("abs(/a/x - /b/x[3]) > 1", {"/a/x": 1.0, "/b/x[3]": 3.0}, True),
        ("/navigator:enable_safety != true", {"/navigator:enable_safety": 0.0}, True),
        ("/robot/navigator:lidar.front.noise > 0.5", {"/robot/navigator:lidar.front.noise": 0.6}, True),
        ("/order/x > 1", {"/order/x": 2.0}, True),
        ("/a/and/b > 1 and /a/or > 1", {"/a/and/b": 2.0, "/a/or": 2.0}, True),
        ("min(/scan/ranges[80:100]) < 1", {"/scan/ranges[80:100].min()": 0.5}, True),
        ("rate(/scan) < 8", {"rate(/scan)": 7.5}, True),
        ("rate(/robot2/scan) < 8 and /odom/x > 1", {"rate(/robot2/scan)": 7.5, "/odom/x": 0.0}, False),
        ("min(/a/x, /b/y) < 1", {"/a/x": 2.0, "/b/y": 0.5}, True),
    ],
)
def test_condition_is_evaluated(text: str, values: dict[str, float], holds: bool) -> None:
    condition = parse_condition(text)
    assert set(condition.paths) == set(values)
    assert condition.holds(values) is holds


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "name a field"),
        ("1 < 2", "name a field"),
        ("/a/b", "compares nothing"),
        ("/a/b <", "side of a comparison"),
        ("/a/b < 1 and", "a comparison is missing"),
        ("/a/b < nonsense", "nonsense"),
        ("min(/a/b", "a comma or a closing bracket is expected"),
        ("mean(/a/b, 1 s) > 2", "time span"),
        ("/a/b or", "compares nothing"),
        ("/a/b < __import__('os')", ""),
        ("/a/b < (1).__class__", ""),
        ("/a/b < 9**9**9", ""),
        (f"/a/b < {'1+' * 300}1", "characters"),
    ],
)
def test_invalid_condition_is_rejected_with_a_reason(text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why or "."):
        parse_condition(text)


def test_evaluation_error_of_a_value_is_raised() -> None:
    condition = parse_condition("1 / /a/b > 2")
    assert condition.holds({"/a/b": 0.25})
    with pytest.raises(ValueError, match="zero"):
        condition.holds({"/a/b": 0.0})


@given(st.text("/ab.x:[]0123<>=!() +-*/andor,_'\"\\", max_size=40))
def test_any_text_is_parsed_or_rejected_with_a_reason(text: str) -> None:
    try:
        condition = parse_condition(text)
    except ValueError as error:
        assert str(error)
    else:
        assert condition.paths
