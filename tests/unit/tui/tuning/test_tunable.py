"""Tunables: values within a range, and the arguments that name them."""

from __future__ import annotations

import math

import pytest
from bot_console.tui.console.model import Range
from bot_console.tui.tuning.tunable import Tunable, find_tunables, parse_range
from hypothesis import given
from hypothesis import strategies as st

SPEED = Tunable("/robot_navigator", "max_speed", "double", 0.1, 5.0, 1.0, "m/s")
LEVEL = Tunable("/robot_navigator", "detection_threshold", "integer", 0, 255, 150)
OTHER = Tunable("/sensor_handler", "detection_threshold", "integer", 0, 255, 150)
SAFE = Tunable("/robot_navigator", "enable_safety", "bool", 0, 1, True)
GAIN = Tunable("/mine", "gain", "double", -math.inf, math.inf, 2.0)
KNOWN = [SPEED, LEVEL, OTHER, SAFE, GAIN]


@given(st.floats(-1, 2), st.floats(-1e6, 1e6), st.floats(0, 1e6))
def test_a_value_stays_within_the_range(share: float, low: float, span: float) -> None:
    tunable = Tunable("/a", "b", "double", low, low + span, low)
    assert tunable.low <= tunable.at(share) <= tunable.high


@given(st.floats(0, 1))
def test_share_converts_to_a_value_and_back_within_the_resolution(share: float) -> None:
    assert SPEED.share(SPEED.at(share)) == pytest.approx(share, abs=0.002)


@pytest.mark.parametrize("tunable", [SPEED, LEVEL, SAFE])
def test_value_beyond_the_range_counts_as_its_end(tunable: Tunable) -> None:
    assert (tunable.share(tunable.low - 1), tunable.share(tunable.high + 1)) == (0.0, 1.0)
    assert (tunable.at(-1.0), tunable.at(2.0)) == (tunable.low, tunable.high)


def test_values_have_the_type_of_the_parameter_and_no_more_digits_than_count() -> None:
    assert SPEED.at(1 / 3) == 1.733
    assert LEVEL.at(0.5) == 128
    assert type(LEVEL.at(0.5)) is int
    assert SAFE.at(0.2) is False
    assert SAFE.at(0.8) is True
    assert (LEVEL.levels, SAFE.levels) == (256, 2)


@pytest.mark.parametrize(
    ("kind", "allowed", "ends", "values"),
    [
        ("double", Range(0.0, 1.0, 0.25), (0.0, 1.0), {0.0, 0.25, 0.5, 0.75, 1.0}),
        ("double", Range(0.1, 1.0, 0.3), (0.3, 0.9), {0.4, 0.7}),
        ("integer", Range(3, 30, 9), (3, 30), {3, 12, 21, 30}),
        ("integer", Range(3, 30, 9), (4, 29), {12, 21}),
    ],
)
def test_values_keep_to_the_step_of_the_descriptor(
    kind: str, allowed: Range, ends: tuple[float, float], values: set[float]
) -> None:
    tunable = Tunable("/a", "b", kind, allowed.low, allowed.high, allowed.low, allowed=allowed).between(*ends)
    assert {tunable.at(index / 100) for index in range(101)} == values and tunable.levels == len(values)


def test_tunables_are_named_by_parameter_or_by_node_and_parameter() -> None:
    found = find_tunables(["max_speed=0.5..2", "robot_navigator:detection_threshold=3..9"], KNOWN)
    assert [(each.label, each.low, each.high) for each in found] == [
        ("/robot_navigator:max_speed", 0.5, 2.0),
        ("/robot_navigator:detection_threshold", 3.0, 9.0),
    ]


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["detection_threshold"], "several nodes have detection_threshold: say which, /robot_navigator:"),
        (["speed"], "no node has a number or boolean 'speed'"),
        (["max_speed=9..10"], "leaves its range, 0.1..5"),
        (["max_speed=2..1"], "the lower end comes first"),
        (["max_speed=fast"], "write for instance 0.2..1.5"),
        (["gain"], "gain=LOW..HIGH"),
        (["max_speed", "max_speed"], "given twice"),
        (["enable_safety=0.2..0.4"], "no whole number"),
        ([], "name at least one"),
    ],
)
def test_unknown_parameter_is_rejected_with_a_hint(words: list[str], why: str) -> None:
    with pytest.raises(ValueError, match="(?s)" + why.replace(".", r"\.")):
        find_tunables(words, KNOWN)


def test_a_parameter_without_a_range_uses_the_given_one() -> None:
    assert find_tunables(["gain=1..3"], KNOWN)[0].high == 3.0


def test_invalid_ends_of_a_range_are_rejected() -> None:
    assert parse_range("-1..2.5") == (-1.0, 2.5)
