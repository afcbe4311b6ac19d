"""Where the arrows run in the channel between two columns. Pure.

All arrows of one item share a trunk, a vertical line in the channel, from which branches lead to the right. Two trunks
whose rows overlap stand on different tracks, and their order is chosen so that few lines cross.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.widgets.diagram.ordering import Key

MANY = 40
"""Trunks in one channel from which on they are no longer sorted pair by pair."""


@dataclass(frozen=True)
class Trunk:
    """The arrows of one item in one channel: it comes in from the left on `enters` (None: from below), branches off to
    the right on the rows `leaves`, and may run down to the row `down`.
    """

    owner: str
    enters: int | None
    leaves: tuple[tuple[int, Key], ...]
    down: int | None = None

    @property
    def rows(self) -> list[int]:
        """Every row on which it has an end or a branch."""
        own = [row for row, _ in self.leaves]
        return own + [row for row in (self.enters, self.down) if row is not None]

    @property
    def straight(self) -> bool:
        """Whether it needs no vertical line."""
        return len(set(self.rows)) == 1


@dataclass(frozen=True)
class Channel:
    """The track of each trunk, counted from the left, how many tracks there are, and keys that stand in the way."""

    track: Mapping[str, int]
    tracks: int
    blocked: tuple[Key, ...]


def channel(trunks: Sequence[Trunk]) -> Channel:
    """Put the trunks that need a vertical line on tracks."""
    bent = [each for each in trunks if not each.straight]
    blocked: list[Key] = []
    order = _order(bent, blocked)
    track: dict[str, int] = {}
    for at, trunk in enumerate(order):
        low, high = min(trunk.rows), max(trunk.rows)
        lower = [
            track[other.owner]
            for other in order[:at]
            if (min(other.rows) <= high + 1 and low <= max(other.rows) + 1) or _must_be_left(other, trunk)
        ]
        track[trunk.owner] = max(lower, default=-1) + 1
    return Channel(track, max(track.values(), default=-1) + 1, tuple(blocked))


def _must_be_left(left: Trunk, right: Trunk) -> bool:
    """Whether two trunks would lie on each other unless the first stands left: one enters where the other leaves."""
    return left.enters is not None and any(row == left.enters for row, _ in right.leaves)


def _order(trunks: Sequence[Trunk], blocked: list[Key]) -> list[Trunk]:
    left = sorted(trunks, key=lambda each: (-(each.enters if each.enters is not None else 1 << 30), each.owner))
    chosen: list[Trunk] = []
    while left:
        free = [each for each in left if not any(_must_be_left(other, each) for other in left if other is not each)]
        if not free:
            blocked += [key for row, key in left[0].leaves if any(row == other.enters for other in left)]
            free = left
        best = free[0] if len(left) > MANY else min(free, key=lambda each: _crossings_if_first(each, left))
        chosen.append(best)
        left.remove(best)
    return chosen


def _crossings_if_first(first: Trunk, others: Sequence[Trunk]) -> int:
    return sum(_crossings(first, each) - _crossings(each, first) for each in others if each is not first)


def _crossings(left: Trunk, right: Trunk) -> int:
    """How often the lines of two trunks cross when the one stands left of the other."""
    low, high = min(right.rows), max(right.rows)
    total = sum(1 for row, _ in left.leaves if low < row < high)
    if right.enters is not None and min(left.rows) < right.enters < max(left.rows):
        total += 1
    return total
