"""The moment that all panes look at: chosen in one of them, followed by the others that have a time axis."""

from __future__ import annotations

from typing import Protocol


class FollowsTime(Protocol):
    """Something that shows the state at a moment."""

    def time_moved(self, stamp: int | None) -> None:
        """Show a moment (ns since the epoch), or the present when it is None."""
        ...


class TimeCursor:
    """One moment for everything that follows it; only the number is shared."""

    def __init__(self) -> None:
        self.stamp: int | None = None
        """The moment, in ns since the epoch; None is now."""
        self._followers: list[FollowsTime] = []

    def follow(self, follower: FollowsTime) -> None:
        """Notify a follower of each move from now on."""
        if follower not in self._followers:
            self._followers.append(follower)

    def leave(self, follower: FollowsTime) -> None:
        """Stop notifying it."""
        if follower in self._followers:
            self._followers.remove(follower)

    def move(self, stamp: int | None, mover: FollowsTime | None = None) -> None:
        """Look at another moment; whoever moves the cursor is not notified."""
        if stamp == self.stamp:
            return
        self.stamp = stamp
        for each in tuple(self._followers):
            if each is not mover:
                each.time_moved(stamp)
