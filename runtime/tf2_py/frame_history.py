"""The history of one frame: its transforms to its parent, over time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable
from operator import itemgetter

from rclpy.constants import S_TO_NS
from tf2_py.rigid import Rigid, interpolate

DIGEST_AFTER = 256
"""How many entries may accumulate before old ones are dropped."""

Entry = tuple[int, str, Rigid, str]
"""Time (ns), parent, transform, and authority."""
Unread = tuple[int, str, float, float, float, float, float, float, float]
"""Time (ns), parent, translation (m) and rotation quaternion of a message; not tracked by the garbage collector."""


class FrameHistory:
    """The transforms of one frame by time; most stay unread, as nobody looks them up."""

    __slots__ = ("_keep", "_read", "_stamps", "entries", "is_static", "waiting")

    def __init__(self, keep: int, is_static: bool, read: Callable[[Unread], None]) -> None:
        """Keep transforms for `keep` (ns); `read` inserts one that was kept unread."""
        self._keep = keep
        self.is_static = is_static
        self._read = read
        self._stamps: list[int] = []
        self.waiting: list[Unread] = []
        self.entries: list[Entry] = []

    def drop_old(self) -> None:
        """Drop unread transforms that are too old, if they arrived in order."""
        waiting = self.waiting
        limit = waiting[-1][0] - self._keep
        old = bisect_left(waiting, limit, key=itemgetter(0))
        if all(each[0] < limit for each in waiting[:old]):
            del waiting[:old]

    def digest(self) -> None:
        """Read the unread transforms."""
        waiting, self.waiting = self.waiting, []
        for each in waiting:
            self._read(each)

    def clear(self) -> None:
        """Forget all transforms, unless the frame is static."""
        if not self.is_static:
            self._stamps, self.waiting, self.entries = [], [], []

    def insert(self, entry: Entry) -> bool:
        """Add a transform; return whether it is recent enough. Different ones with the same time are all kept."""
        if self.is_static:
            self.entries, self._stamps = [entry], [0]
            return True
        stamps = self._stamps
        stamp = entry[0]
        if not stamps or stamp > stamps[-1]:
            stamps.append(stamp)
            self.entries.append(entry)
            self._prune()
            return True
        if stamp < stamps[-1] - self._keep:
            return False
        first, place = bisect_left(stamps, stamp), bisect_right(stamps, stamp)
        if all(entry[:3] != each[:3] for each in self.entries[first:place]):
            stamps.insert(place, stamp)
            self.entries.insert(place, entry)
        return True

    def _prune(self) -> None:
        """Drop many old entries at once, as removing one from the front takes time proportional to the length."""
        limit = self._stamps[-1] - self._keep
        if self._stamps[0] >= limit:
            return
        old = bisect_left(self._stamps, limit)
        if old > DIGEST_AFTER or old * 2 > len(self._stamps):
            del self._stamps[:old]
            del self.entries[:old]

    @property
    def first(self) -> int:
        """Index of the oldest entry that is still valid."""
        return bisect_left(self._stamps, self._stamps[-1] - self._keep) if self._stamps else 0

    def latest(self) -> tuple[int, str] | None:
        """Return the newest time (ns; 0 for a static frame) and the parent then; None if there are no transforms."""
        if self.waiting:
            self.digest()
        if not self.entries:
            return None
        return (0 if self.is_static else self._stamps[-1]), self.entries[-1][1]

    def at(self, time: int) -> tuple[str, Rigid]:
        """Return parent and transform at a time (ns; 0 means the newest); `LookupError` with upstream's message."""
        if self.waiting:
            self.digest()
        entries, stamps = self.entries, self._stamps
        if not entries:
            raise LookupError("")
        newest = stamps[-1]
        if self.is_static or not time or time == newest:
            _, parent, place, _ = entries[-1]
            return parent, place
        after = bisect_right(stamps, time)
        if time > newest or not after or stamps[after - 1] < newest - self._keep:
            raise LookupError(self._extrapolation_message(time, self.first))
        stamp, parent, place, _ = entries[after - 1]
        if stamp == time:
            first = self.first
            if stamps[first] == time:  # of several with the oldest time, tf2 returns the one that arrived first
                _, parent, place, _ = entries[first]
            return parent, place
        later, other_parent, other_place, _ = entries[after]
        if parent != other_parent:
            return parent, place
        return parent, interpolate(place, other_place, (time - stamp) / (later - stamp))

    def _extrapolation_message(self, time: int, first: int) -> str:
        oldest, newest = self._stamps[first], self._stamps[-1]
        if oldest == newest:
            asked, only = seconds(time), seconds(newest)
            return f"Lookup would require extrapolation at time {asked}, but only time {only} is in the buffer"
        if time > newest:
            return (
                f"Lookup would require extrapolation into the future.  Requested time {seconds(time)} but the latest "
                f"data is at time {seconds(newest)}"
            )
        return (
            f"Lookup would require extrapolation into the past.  Requested time {seconds(time)} but the earliest data "
            f"is at time {seconds(oldest)}"
        )


def seconds(time: int) -> str:
    """Return a time (ns) as upstream prints it."""
    return f"{time / S_TO_NS:.6f}"
