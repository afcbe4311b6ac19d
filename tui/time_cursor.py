"""The moment that all panes look at: chosen in one of them, shown by the others that have time."""

from __future__ import annotations

from typing import Protocol


class LooksAtTime(Protocol):
    """Something that shows what was at a moment."""

    def time_moved(self, stamp: int | None) -> None:
        """Look at a moment (ns since the epoch), or, at None, at what is now."""
        ...


class TimeCursor:
    """One moment for everybody who follows; nothing is shared but the number."""

    def __init__(self) -> None:
        self.stamp: int | None = None
        """The moment, in ns since the epoch; None is now."""
        self._followers: list[LooksAtTime] = []

    def follow(self, follower: LooksAtTime) -> None:
        """Tell of each move from now on."""
        if follower not in self._followers:
            self._followers.append(follower)

    def leave(self, follower: LooksAtTime) -> None:
        """Tell no more."""
        if follower in self._followers:
            self._followers.remove(follower)

    def move(self, stamp: int | None, mover: LooksAtTime | None = None) -> None:
        """Look at another moment; whoever moves the cursor is not told."""
        if stamp == self.stamp:
            return
        self.stamp = stamp
        for each in tuple(self._followers):
            if each is not mover:
                each.time_moved(stamp)
