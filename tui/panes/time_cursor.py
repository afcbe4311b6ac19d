"""The time cursor: a moment that is chosen in one pane, and shown by all others that have a time axis."""

from __future__ import annotations

from typing import Protocol


class FollowsTime(Protocol):
    """Something that shows the state at a moment."""

    def time_moved(self, stamp: int | None) -> None:
        """Show a moment (ns since the epoch), or for None the present."""
        ...


class TimeCursor:
    """A moment, and the followers that are notified when it moves."""

    def __init__(self) -> None:
        self.stamp: int | None = None
        """The moment, in ns since the epoch; None is now."""
        self._followers: list[FollowsTime] = []

    def follow(self, follower: FollowsTime) -> None:
        """Notify a follower of each move from now on."""
        if follower not in self._followers:
            self._followers.append(follower)

    def leave(self, follower: FollowsTime) -> None:
        """Stop notifying a follower."""
        if follower in self._followers:
            self._followers.remove(follower)

    def move(self, stamp: int | None, mover: FollowsTime | None = None) -> None:
        """Move to another moment, and notify all followers but the `mover`."""
        if stamp == self.stamp:
            return
        self.stamp = stamp
        for each in tuple(self._followers):
            if each is not mover:
                each.time_moved(stamp)
