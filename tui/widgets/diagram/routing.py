"""Routes arrows through the channel between two columns. Pure.

All arrows of one item share a trunk, a vertical line in the channel from which branches lead to the right. Trunks whose
rows overlap get different tracks, ordered so that few lines cross.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from bot_console.tui.widgets.diagram.ordering import Key

MANY = 40
"""Maximum number of trunks in a channel that are still compared pair by pair."""


@dataclass(frozen=True)
class Trunk:
    """The arrows of one item in one channel: the trunk enters from the left on row `enters` (None: from below),
    branches off to the right on the rows `leaves`, and may run down to row `down`.
    """

    owner: str
    enters: int | None
    leaves: tuple[tuple[int, Key], ...]
    down: int | None = None

    @cached_property
    def span(self) -> tuple[int, int]:
        """The first and the last row with an end or a branch."""
        rows = [row for row, _ in self.leaves]
        rows += [row for row in (self.enters, self.down) if row is not None]
        return min(rows), max(rows)

    @property
    def straight(self) -> bool:
        """Whether the trunk needs no vertical line."""
        return self.span[0] == self.span[1]


@dataclass(frozen=True)
class Channel:
    """The track of each trunk, counted from the left, the number of tracks, and the keys that are in the way."""

    track: Mapping[str, int]
    tracks: int
    blocked: tuple[Key, ...]


def channel(trunks: Sequence[Trunk]) -> Channel:
    """Assign tracks to the trunks that need a vertical line."""
    bent = [each for each in trunks if not each.straight]
    left_of = _left_of(bent)
    blocked: list[Key] = []
    order = _order(bent, left_of, blocked)
    track: dict[str, int] = {}
    for at, trunk in enumerate(order):
        low, high = trunk.span
        lower = [track[each] for each in left_of[trunk.owner] if each in track]
        for other in order[:at]:
            first, last = other.span
            if first <= high + 1 and low <= last + 1:
                lower.append(track[other.owner])
        track[trunk.owner] = max(lower, default=-1) + 1
    return Channel(track, max(track.values(), default=-1) + 1, tuple(blocked))


def _left_of(trunks: Sequence[Trunk]) -> dict[str, set[str]]:
    """For each trunk, the owners of those that must be left of it: they enter on rows on which it leaves."""
    entering = {each.enters: each.owner for each in trunks if each.enters is not None}
    return {each.owner: {entering[row] for row, _ in each.leaves if row in entering} - {each.owner} for each in trunks}


def _order(trunks: Sequence[Trunk], left_of: Mapping[str, set[str]], blocked: list[Key]) -> list[Trunk]:
    """Order the trunks from the left; `blocked` receives the keys in the way if trunks wait for each other."""
    left = {
        each.owner: each
        for each in sorted(
            trunks, key=lambda each: (-(each.enters if each.enters is not None else 1 << 30), each.owner)
        )
    }
    cost = _costs(list(left.values())) if len(left) <= MANY else {}
    chosen: list[Trunk] = []
    while left:
        free = [each for each in left if not any(other in left for other in left_of[each])]
        if not free:
            first = next(iter(left.values()))
            waiting = {each.enters for each in left.values()}
            blocked += [key for row, key in first.leaves if row in waiting]
            free = list(left)
        scores = {each: sum(cost[each, other] for other in left if other != each) for each in free} if cost else {}
        best = min(free, key=lambda each: scores[each]) if scores else free[0]
        chosen.append(left.pop(best))
    return chosen


def _costs(trunks: Sequence[Trunk]) -> dict[tuple[str, str], int]:
    """The number of crossings saved or caused by putting the first of a pair on the left."""
    return {(a.owner, b.owner): _crossings(a, b) - _crossings(b, a) for a in trunks for b in trunks if a is not b}


def _crossings(left: Trunk, right: Trunk) -> int:
    """The number of crossings of two trunks if the first is left of the second."""
    low, high = right.span
    total = sum(1 for row, _ in left.leaves if low < row < high)
    if right.enters is not None and left.span[0] < right.enters < left.span[1]:
        total += 1
    return total
