"""Figures of step responses, compared with curves whose figures can be calculated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from bot_console.tui.console.model import Change, ChangeSource
from bot_console.tui.panes.plot.responses import Responses
from bot_console.tui.panes.plot.step_response import figures, figures_text, moments, response, score

TIMES = np.linspace(-1.0, 20.0, 21_001)


def first_order(tau: float, step: float = 2.0, start: float = 1.0) -> np.ndarray:
    return np.where(TIMES < 0, start, start + step * (1 - np.exp(-np.maximum(TIMES, 0) / tau)))


def second_order(damping: float, frequency: float = 2.0) -> np.ndarray:
    natural = frequency / math.sqrt(1 - damping**2)
    time = np.maximum(TIMES, 0)
    decay = np.exp(-damping * natural * time)
    wave = np.cos(frequency * time) + damping * natural / frequency * np.sin(frequency * time)
    return 1 - decay * wave


def of(values: np.ndarray):
    found = response("set B", TIMES, values, 0.0, 20.0)
    assert found is not None
    return found


def test_first_order_lag_has_the_expected_figures() -> None:
    """Rise time is tau ln 9, settling time to 5 % is tau ln 20, and there is no overshoot."""
    found = figures(of(first_order(0.8)), reference=3.5)
    assert found.rise == pytest.approx(0.8 * math.log(9), rel=0.01)
    assert found.settling == pytest.approx(0.8 * math.log(20), rel=0.01)
    assert found.overshoot == pytest.approx(0.0, abs=1e-3)
    assert found.error == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize("damping", [0.2, 0.5])
def test_a_system_of_second_order_overshoots_by_its_damping(damping: float) -> None:
    found = figures(of(second_order(damping)))
    assert found.overshoot == pytest.approx(math.exp(-math.pi * damping / math.sqrt(1 - damping**2)), rel=0.02)
    assert math.isnan(found.error)


def test_a_step_down_has_the_same_figures() -> None:
    up, down = figures(of(first_order(0.8))), figures(of(first_order(0.8, step=-2.0)))
    assert (up.rise, up.settling) == pytest.approx((down.rise, down.settling))


def test_unsettled_response_and_missing_step_are_reported() -> None:
    growing = figures(of(TIMES))
    assert math.isnan(growing.settling)
    still = figures(of(np.ones_like(TIMES)), reference=1.5)
    assert math.isnan(still.rise) and still.error == 0.5
    assert "rise –" in figures_text(still)


def test_custom_score_is_evaluated() -> None:
    found = figures(of(first_order(0.8)), reference=3.0)
    assert score("10*overshoot + settling", found) == pytest.approx(found.settling, abs=0.01)
    assert "score 2.397" in figures_text(found, "settling")
    with pytest.raises(ValueError, match="not one of"):
        score("speed", found)


def test_latest_response_of_each_set_is_used() -> None:
    changes = [
        Change(at, at, "/n", "p", 0, 1, ChangeSource.EDIT, by=name)
        for at, name in enumerate(["set B", "", "set A", "set B"])
    ]
    assert moments(changes) == {"set A": 2, "set B": 3}


@pytest.mark.parametrize("width", [40, 98, 200])
def test_what_to_do_for_responses_is_shown_in_full(width: int) -> None:
    lines = Responses(None).draw((), 0, 30.0, (width, 20))  # type: ignore[arg-type] -- without curves, nothing is read
    shown = ["".join(text for text, _ in line) for line in lines]
    assert max(map(len, shown)) <= width and "A again sends set A." in " ".join(" ".join(shown).split())
