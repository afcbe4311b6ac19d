"""Chooses the settings to try next: on a grid, at random, or closer and closer to the best. Pure and repeatable.

A search produces one generation at a time from the seed and the settings tried so far. It depends neither on how many
runs are made in parallel nor on which of them ends first.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.tuning.tunable import Setting, Tunable

GENERATION_SIZE = 4
"""Settings that an adaptive search asks for at a time."""
FIRST_WIDTH_SHARE = 0.2
"""Standard deviation of the first steps of an adaptive search, as a share of the range."""
NARROWING_FACTOR = 0.8
"""Factor by which the width shrinks with each generation."""
MAX_ATTEMPTS = 20
"""Maximum attempts at finding a setting that was not tried before."""


@dataclass(frozen=True)
class TriedSetting:
    """A setting and its score; minus infinity for one that failed."""

    setting: Setting
    score: float


def next_settings(
    search: str, tunables: Sequence[Tunable], budget: int, seed: int, tried: Sequence[TriedSetting]
) -> Sequence[Setting]:
    """The next settings of a search with a total of `budget` settings; empty if there is nothing more to try.

    The first one always consists of the present values.
    """
    left = budget - len(tried)
    if left <= 0:
        return ()
    if not tried:
        return (tuple(each.now for each in tunables),)
    known = {each.setting for each in tried}
    wanted = SEARCHES[search](tunables, budget, seed, tried)
    return tuple(dict.fromkeys(each for each in wanted if each not in known))[:left]


def _grid(tunables: Sequence[Tunable], budget: int, seed: int, tried: Sequence[TriedSetting]) -> Sequence[Setting]:
    """All combinations of evenly spaced values, with as many values of each tunable as the budget allows."""
    levels = grid_levels(tunables, budget - 1)
    settings: list[Setting] = [()]
    for tunable, count in zip(tunables, levels, strict=True):
        values = [tunable.at(index / (count - 1) if count > 1 else 0.5) for index in range(count)]
        settings = [(*before, value) for before in settings for value in dict.fromkeys(values)]
    return settings


def grid_levels(tunables: Sequence[Tunable], budget: int) -> list[int]:
    """How many values each tunable gets, so that there are at most `budget` settings."""
    levels = [1] * len(tunables)
    while True:
        growing = [
            index
            for index, tunable in enumerate(tunables)
            if levels[index] < tunable.levels and math.prod(levels) // levels[index] * (levels[index] + 1) <= budget
        ]
        if not growing:
            return levels
        levels[min(growing, key=lambda index: levels[index])] += 1


def _random(tunables: Sequence[Tunable], budget: int, seed: int, tried: Sequence[TriedSetting]) -> Sequence[Setting]:
    return _spread(tunables, budget - 1, random.Random(f"{seed}/spread"))


def _spread(tunables: Sequence[Tunable], count: int, chance: random.Random) -> list[Setting]:
    """Random settings in which each tunable has one value in each of `count` equal parts of its range (a Latin
    hypercube).
    """
    columns = [
        [tunable.at((part + chance.random()) / count) for part in chance.sample(range(count), count)]
        for tunable in tunables
    ]
    return list(zip(*columns, strict=True))


def _adaptive(tunables: Sequence[Tunable], budget: int, seed: int, tried: Sequence[TriedSetting]) -> Sequence[Setting]:
    """Spread a third of the budget over the ranges; then step around the best settings in ever smaller steps.

    Half of a generation starts from the best setting, the other half from the mean of the best quarter.
    """
    first = max(1, (budget - 1) // 3)
    if len(tried) <= first:
        return _spread(tunables, first, random.Random(f"{seed}/spread"))
    chance = random.Random(f"{seed}/{len(tried)}")
    width = FIRST_WIDTH_SHARE * NARROWING_FACTOR ** ((len(tried) - 1 - first) // GENERATION_SIZE)
    ranked = sorted(tried, key=lambda each: each.score, reverse=True)
    shares = [[tunable.share(value) for tunable, value in zip(tunables, each.setting, strict=True)] for each in ranked]
    quarter = shares[: max(1, len(shares) // 4)]
    middle = [sum(column) / len(column) for column in zip(*quarter, strict=True)]
    known = {each.setting for each in tried}
    found: list[Setting] = []
    for index in range(GENERATION_SIZE):
        for _ in range(MAX_ATTEMPTS):
            setting = _near(tunables, shares[0] if index % 2 == 0 else middle, width, chance)
            if setting not in known:
                known.add(setting)
                found.append(setting)
                break
    return found


def _near(tunables: Sequence[Tunable], origin: Sequence[float], width: float, chance: random.Random) -> Setting:
    """A setting near another one; a boolean is flipped with a chance of one in four."""
    setting: list[bool | int | float] = []
    for tunable, share in zip(tunables, origin, strict=True):
        if tunable.kind == "bool":
            setting.append(bool(share >= 0.5) != (chance.random() < 0.25))
        else:
            setting.append(tunable.at(_reflected(share + chance.gauss(0.0, width))))
    return tuple(setting)


def _reflected(share: float) -> float:
    """A share beyond 0 or 1 reflected at that border, instead of clamped to it."""
    share = math.fmod(abs(share), 2.0)
    return 2.0 - share if share > 1.0 else share


SEARCHES: Mapping[str, Callable[[Sequence[Tunable], int, int, Sequence[TriedSetting]], Sequence[Setting]]] = {
    "adaptive": _adaptive,
    "grid": _grid,
    "random": _random,
}
"""The searches by the names that users give."""
