"""A cache of the newest messages, ordered by time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import Any

from message_filters.simple_filter import SimpleFilter
from message_filters.stamps import stamp_of
from rclpy.time import Time


class Cache(SimpleFilter):
    """Keeps the last `cache_size` messages of a filter in order of time, and passes messages on."""

    def __init__(self, f: object = None, cache_size: int = 1, allow_headerless: bool = False) -> None:
        super().__init__()
        if f is not None:
            self.connectInput(f)
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Time] = []

    def connectInput(self, f: Any) -> None:
        """Connect to the output of a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: object) -> None:
        """Add a message; the oldest one is dropped if there are too many."""
        stamp = stamp_of(msg, self.allow_headerless, "cache")
        if stamp is None:
            return
        if self.cache_msgs and len(self.cache_msgs) >= self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        place = bisect_right(self.cache_times, stamp)
        self.cache_msgs.insert(place, msg)
        self.cache_times.insert(place, stamp)
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:
        """Return the messages from one time to another, both inclusive."""
        assert from_stamp <= to_stamp
        return self.cache_msgs[bisect_left(self.cache_times, from_stamp) : bisect_right(self.cache_times, to_stamp)]

    def getElemAfterTime(self, stamp: Time) -> Any:
        """Return the first message at or after a time; None if there is none."""
        place = bisect_left(self.cache_times, stamp)
        return self.cache_msgs[place] if place < len(self.cache_msgs) else None

    def getElemBeforeTime(self, stamp: Time) -> Any:
        """Return the last message at or before a time; None if there is none."""
        place = bisect_right(self.cache_times, stamp)
        return self.cache_msgs[place - 1] if place else None

    def getLastestTime(self) -> Time | None:
        """Return the time of the newest message; the name is upstream's."""
        return self.cache_times[-1] if self.cache_times else None

    getLatestTime = getLastestTime  # noqa: N815 -- upstream's name

    def getOldestTime(self) -> Time | None:
        """Return the time of the oldest message."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:
        """Return the newest message; None if there is none."""
        return self.cache_msgs[-1] if self.cache_msgs else None
