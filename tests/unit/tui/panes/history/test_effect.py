"""How the speed of the robot changed after a parameter change."""

from __future__ import annotations

import math
from collections.abc import Callable

from bot_console.tui.panes.history.effect import WATCH_S, Effects


def drive(effects: Effects, begin: float, seconds: float, speed: Callable[[float], float]) -> bool:
    """Feed speeds ten times a second; return whether anything new became known about a change."""
    return any([effects.observe(speed(at / 10), begin + at / 10) for at in range(round(10 * seconds))])


def test_step_of_the_speed_is_reported_with_the_time_that_it_took() -> None:
    effects = Effects()
    drive(effects, 0.0, 2.0, lambda _: 0.5)
    effects.changed([7, 8], 2.0)
    assert drive(effects, 2.0, WATCH_S + 0.2, lambda at: min(1.0, 0.5 + 0.6 * at))
    assert effects.of(7) == effects.of(8) == "speed 0.5 → 1.0 m/s in 0.8 s" and effects.of(6) == ""


def test_constant_speed_is_not_an_effect() -> None:
    effects = Effects()
    drive(effects, 0.0, 2.0, lambda at: 0.5 + 0.02 * math.sin(9 * at))
    effects.changed([1], 2.0)
    assert not drive(effects, 2.0, 2 * WATCH_S, lambda at: 0.5 + 0.02 * math.sin(9 * at)) and effects.of(1) == ""


def test_next_change_ends_the_effect_of_the_previous_one() -> None:
    effects = Effects()
    drive(effects, 0.0, 1.0, lambda _: 0.5)
    effects.changed([1], 1.0)
    drive(effects, 1.0, 2.0, lambda _: 1.0)
    effects.changed([2], 3.0)
    drive(effects, 3.0, 0.5, lambda _: 0.2)
    effects.changed([3], 3.5)
    assert effects.of(1) == "speed 0.5 → 1.0 m/s in 0.1 s"
    assert effects.of(2) == "", "too early to be known"


def test_nothing_is_known_without_odometry() -> None:
    effects = Effects()
    effects.changed([1], 0.0)
    drive(effects, 0.0, 2 * WATCH_S, lambda _: 1.0)
    effects.changed([2], 10.0)
    effects.observe(None, 10.1)
    drive(effects, 10.2, 2 * WATCH_S, lambda _: 0.1)
    assert effects.of(1) == effects.of(2) == ""
