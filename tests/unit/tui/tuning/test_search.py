"""Searches: repeatable, within their budget and ranges, and the adaptive one finds a hill."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from bot_console.tui.tuning.search import SEARCHES, TriedSetting, grid_levels, next_settings
from bot_console.tui.tuning.tunable import Setting, Tunable
from hypothesis import given
from hypothesis import strategies as st

X = Tunable("/a", "x", "double", 0.0, 1.0, 0.9)
Y = Tunable("/a", "y", "double", -2.0, 2.0, 1.9)
N = Tunable("/a", "n", "integer", 0, 3, 0)
B = Tunable("/a", "b", "bool", 0, 1, True)


def hill(setting: Setting) -> float:
    return -math.dist((setting[0], setting[1] / 4), (0.3, 0.1))


def searched(search: str, tunables: tuple[Tunable, ...], budget: int, seed: int, score: Callable[[Setting], float]):
    tried: list[TriedSetting] = []
    while settings := next_settings(search, tunables, budget, seed, tried):
        tried += [TriedSetting(each, score(each)) for each in settings]
    return tried


@given(
    st.sampled_from(sorted(SEARCHES)),
    st.lists(st.sampled_from([X, Y, N, B]), min_size=1, max_size=4, unique_by=lambda each: each.name),
    st.integers(2, 40),
    st.integers(0, 5),
)
def test_a_search_keeps_to_budget_and_ranges_and_tries_nothing_twice(search, tunables, budget, seed) -> None:
    def score(setting: Setting) -> float:
        return math.fsum(map(float, setting))

    tried = searched(search, tuple(tunables), budget, seed, score)
    settings = [each.setting for each in tried]
    assert 1 <= len(settings) <= budget
    assert len(set(settings)) == len(settings)
    assert settings[0] == tuple(each.now for each in tunables)
    for setting in settings:
        assert all(tunable.low <= value <= tunable.high for tunable, value in zip(tunables, setting, strict=True))
    assert searched(search, tuple(tunables), budget, seed, score) == tried


def test_another_seed_tries_other_settings() -> None:
    assert searched("random", (X, Y), 10, 1, hill) != searched("random", (X, Y), 10, 2, hill)


def test_adaptive_search_comes_closer_than_random_search() -> None:
    def best(search: str) -> list[float]:
        return [max(each.score for each in searched(search, (X, Y), 30, seed, hill)) for seed in range(9)]

    assert sorted(best("adaptive"))[4] > 0.5 * sorted(best("random"))[4]


def test_adaptive_search_steps_back_from_a_border_instead_of_staying_there() -> None:
    corner = (Tunable("/a", "x", "double", 0.0, 1.0, 1.0), Tunable("/a", "y", "double", -2.0, 2.0, 2.0))
    tried = searched("adaptive", corner, 30, 1, lambda setting: setting[0] + setting[1])
    at_border = [each for each in tried[1:] if each.setting[0] == 1.0 or each.setting[1] == 2.0]
    assert len(at_border) < 3, "half of all steps lead beyond each border"


def test_adaptive_search_continues_after_failed_settings() -> None:
    assert len(searched("adaptive", (X, Y), 20, 1, lambda setting: -math.inf)) == 20


@pytest.mark.parametrize(
    ("tunables", "budget", "levels"),
    [((X, Y), 9, [3, 3]), ((X, Y), 11, [4, 2]), ((X, B), 60, [30, 2]), ((N,), 60, [4])],
)
def test_a_grid_has_as_many_levels_as_the_budget_allows(tunables, budget, levels) -> None:
    found = grid_levels(tunables, budget)
    assert math.prod(found) <= budget
    assert found == levels or math.prod(found) >= math.prod(levels)


def test_a_grid_reaches_both_ends() -> None:
    tried = searched("grid", (X,), 6, 1, lambda setting: 0.0)
    assert [each.setting[0] for each in tried] == [0.9, 0.0, 0.25, 0.5, 0.75, 1.0]
