"""Which settings to try next: on a grid, at random, or closer and closer to the best. Pure and repeatable.

A search produces one generation at a time, from the seed and from what was tried: nothing depends on how many runs go
on in parallel, nor on which of them ends first.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.tuning.dial import Dial, Setting

GENERATION = 4
"""Settings that an adaptive search asks for at a time."""
WIDTH = 0.2
"""Standard deviation of the first steps of an adaptive search, as a share of the range."""
NARROWING = 0.8
"""Of the width, what is left of it for the next generation."""
PATIENCE = 20
"""Attempts at a setting that was not tried before."""


@dataclass(frozen=True)
class Tried:
    """A setting and its score; minus infinity for one that failed."""

    setting: Setting
    score: float


def next_settings(
    search: str, dials: Sequence[Dial], budget: int, seed: int, tried: Sequence[Tried]
) -> Sequence[Setting]:
    """The next settings of a search of `budget` settings in all; none when there is nothing more to try.

    The first one is always how the parameters are now.
    """
    left = budget - len(tried)
    if left <= 0:
        return ()
    if not tried:
        return (tuple(each.now for each in dials),)
    known = {each.setting for each in tried}
    wanted = SEARCHES[search](dials, budget, seed, tried)
    return tuple(dict.fromkeys(each for each in wanted if each not in known))[:left]


def _grid(dials: Sequence[Dial], budget: int, seed: int, tried: Sequence[Tried]) -> Sequence[Setting]:
    """Evenly spaced values; as many for each dial as the budget allows."""
    levels = grid_levels(dials, budget - 1)
    settings: list[Setting] = [()]
    for dial, count in zip(dials, levels, strict=True):
        values = [dial.at(index / (count - 1) if count > 1 else 0.5) for index in range(count)]
        settings = [(*before, value) for before in settings for value in dict.fromkeys(values)]
    return settings


def grid_levels(dials: Sequence[Dial], budget: int) -> list[int]:
    """How many values each dial gets, so that there are at most `budget` settings."""
    levels = [1] * len(dials)
    while True:
        growing = [
            index
            for index, dial in enumerate(dials)
            if levels[index] < dial.levels and math.prod(levels) // levels[index] * (levels[index] + 1) <= budget
        ]
        if not growing:
            return levels
        levels[min(growing, key=lambda index: levels[index])] += 1


def _random(dials: Sequence[Dial], budget: int, seed: int, tried: Sequence[Tried]) -> Sequence[Setting]:
    return _spread(dials, budget - 1, random.Random(f"{seed}/spread"))


def _spread(dials: Sequence[Dial], count: int, chance: random.Random) -> list[Setting]:
    """Random settings of which each dial's values lie in as many equal parts of its range (a latin hypercube)."""
    columns = [
        [dial.at((part + chance.random()) / count) for part in chance.sample(range(count), count)] for dial in dials
    ]
    return list(zip(*columns, strict=True))


def _adaptive(dials: Sequence[Dial], budget: int, seed: int, tried: Sequence[Tried]) -> Sequence[Setting]:
    """A third of the budget is spread; then each generation steps around the best, ever narrower.

    Half of a generation starts from the best setting, half from the middle of the best quarter.
    """
    first = max(1, (budget - 1) // 3)
    if len(tried) <= first:
        return _spread(dials, first, random.Random(f"{seed}/spread"))
    chance = random.Random(f"{seed}/{len(tried)}")
    width = WIDTH * NARROWING ** ((len(tried) - 1 - first) // GENERATION)
    ranked = sorted(tried, key=lambda each: each.score, reverse=True)
    shares = [[dial.share(value) for dial, value in zip(dials, each.setting, strict=True)] for each in ranked]
    quarter = shares[: max(1, len(shares) // 4)]
    middle = [sum(column) / len(column) for column in zip(*quarter, strict=True)]
    known = {each.setting for each in tried}
    found: list[Setting] = []
    for index in range(GENERATION):
        for _ in range(PATIENCE):
            setting = _near(dials, shares[0] if index % 2 == 0 else middle, width, chance)
            if setting not in known:
                known.add(setting)
                found.append(setting)
                break
    return found


def _near(dials: Sequence[Dial], origin: Sequence[float], width: float, chance: random.Random) -> Setting:
    """A setting near another one; a boolean changes sides with a chance of one in four."""
    setting: list[bool | int | float] = []
    for dial, share in zip(dials, origin, strict=True):
        if dial.kind == "bool":
            setting.append(bool(share >= 0.5) != (chance.random() < 0.25))
        else:
            setting.append(dial.at(_reflected(share + chance.gauss(0.0, width))))
    return tuple(setting)


def _reflected(share: float) -> float:
    """A share that has left 0 to 1, thrown back at the border rather than kept on it."""
    share = math.fmod(abs(share), 2.0)
    return 2.0 - share if share > 1.0 else share


SEARCHES: Mapping[str, Callable[[Sequence[Dial], int, int, Sequence[Tried]], Sequence[Setting]]] = {
    "adaptive": _adaptive,
    "grid": _grid,
    "random": _random,
}
"""By the word that a person gives."""
