"""Scores: formulas over a run's report; a formula that cannot be right is refused before the first run."""

from __future__ import annotations

import pytest
from bot_console.tui.tuning.score import BUILT_IN_SCORES, parse_score, statistics

REPORT = {
    "mean_speed": 1.5,
    "distance": 90.0,
    "collisions": 1,
    "min_clearance": 0.05,
    "stops": 2,
    "longest_standstill": 3.0,
    "duration": 60.0,
    "topics": {"/odom/twist.twist.linear.x": statistics([1.0, 2.0, 3.0])},
}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("swift", 1.5 - 2 - 5 * 0.1),
        ("steady", 1.5 - 0.2 - 0.05 - 2),
        ("roomy", 0.05 + 0.3 - 2),
        ("distance / 2", 45.0),
        ("mean_speed - mean(/odom/twist.twist.linear.x)", -0.5),
        ("greatest( /odom/twist.twist.linear.x ) + least(/odom/twist.twist.linear.x)", 4.0),
    ],
)
def test_score_is_evaluated(text: str, value: float) -> None:
    assert parse_score(text).of(REPORT) == pytest.approx(value)


@pytest.mark.parametrize("name", BUILT_IN_SCORES)
def test_a_collision_costs_in_every_ready_score(name: str) -> None:
    score = parse_score(name)
    assert score.of({**REPORT, "collisions": 0}) - score.of(REPORT) == pytest.approx(2.0)


def test_clearance_is_infinite_without_obstacles() -> None:
    assert parse_score("swift").of({**REPORT, "min_clearance": None, "collisions": 0}) == pytest.approx(1.5)


@pytest.mark.parametrize("text", ["spede", "mean_speed +", "__import__('os')", "mean_speed.real", "open(1)", "speed*2"])
def test_invalid_formula_is_rejected(text: str) -> None:
    with pytest.raises(ValueError, match=r"\w"):
        parse_score(text)


def test_a_name_that_is_neither_score_nor_figure_lists_the_valid_names() -> None:
    with pytest.raises(ValueError, match="choose from swift, steady, roomy"):
        parse_score("fastest")


def test_a_formula_that_divides_by_a_figure_may_still_be_right() -> None:
    assert parse_score("distance / (duration - 1)").of(REPORT) == pytest.approx(90 / 59)


def test_silent_topic_is_named() -> None:
    with pytest.raises(ValueError, match="no message arrived on /imu/x"):
        parse_score("mean(/imu/x)").of({**REPORT, "topics": {"/imu/x": statistics([])}})


def test_infinite_score_is_rejected() -> None:
    with pytest.raises(ValueError, match="the score is inf"):
        parse_score("min_clearance").of({**REPORT, "min_clearance": None})


def test_figures_are_computed_from_samples() -> None:
    assert statistics([3.0, -4.0]) == {"mean": -0.5, "least": -4.0, "greatest": 3.0, "last": -4.0, "rms": 12.5**0.5}
