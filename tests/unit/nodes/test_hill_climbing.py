"""Hill climbing: it finds a hill, stays within its range, and never returns to dangerous values."""

from __future__ import annotations

from bot_console_robot.hill_climbing import HillClimber
from hypothesis import given
from hypothesis import strategies as st


def climbed(top: float, begin: float, periods: int = 60) -> HillClimber:
    climber = HillClimber(0.0, 10.0, begin, 1.0)
    for _ in range(periods):
        climber.record_score(-abs(climber.value - top))
    return climber


@given(st.floats(0, 10), st.floats(0, 10))
def test_climbing_approaches_the_top_from_anywhere(top: float, begin: float) -> None:
    assert abs(climbed(top, begin).best - top) <= 0.6


@given(st.lists(st.tuples(st.floats(-5, 5), st.booleans()), max_size=40), st.floats(0, 10))
def test_climbing_stays_in_range_and_avoids_dangerous_values(steps: list[tuple[float, bool]], begin: float) -> None:
    climber = HillClimber(0.0, 10.0, begin, 1.0)
    for score, dangerous in steps:
        value = climber.record_danger() if dangerous else climber.record_score(score)
        assert value == climber.value
        assert 0.0 <= climber.low <= value <= climber.high <= 10.0


def test_collision_on_the_way_up_limits_the_range() -> None:
    climber = HillClimber(0.0, 10.0, 5.0, 1.0)
    assert climber.record_score(1.0) == 6.0
    assert climber.record_danger() == 5.0
    assert climber.high == 5.0
    for _ in range(20):
        assert climber.record_score(climber.value) <= 5.0


def test_value_is_not_blamed_for_a_place_that_became_slow() -> None:
    climber = HillClimber(0.0, 10.0, 5.0, 1.0)
    climber.record_score(3.0)
    climber.record_score(2.0)
    assert climber.value == 5.0
    climber.record_score(1.0)
    assert climber.value != 5.0
