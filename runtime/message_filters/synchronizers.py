"""Combines messages of several filters that have the same or similar times."""

from __future__ import annotations

import itertools
import threading
from typing import Any

from message_filters.simple_filter import SimpleFilter
from message_filters.stamps import header_stamp, stamp_of
from rclpy.duration import Duration

Queue = dict[int, Any]
"""Messages by time (ns)."""


class TimeSynchronizer(SimpleFilter):
    """Passes on one message of each filter if all have exactly the same time."""

    def __init__(self, fs: list[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self.connectInput(fs)
        self.queue_size = queue_size
        self.lock = threading.RLock()

    def connectInput(self, fs: list[SimpleFilter]) -> None:
        """Connect to the outputs of filters."""
        self.queues: list[Queue] = [{} for _ in fs]
        self.input_connections = [
            each.registerCallback(self.add, queue, index)
            for index, (each, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def _keep(self, stamp: int, msg: object, queue: Queue) -> None:
        """Add a message; the oldest ones are dropped if there are too many."""
        queue[stamp] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]

    def add(self, msg: object, my_queue: Queue, my_queue_index: int | None = None) -> None:
        """Add a message of one filter; raises `AttributeError` if it has no header."""
        stamp = header_stamp(msg).nanoseconds
        with self.lock:
            self._keep(stamp, msg, my_queue)
            common = set(self.queues[0]).intersection(*self.queues[1:])
            for each in sorted(common):
                messages = [queue[each] for queue in self.queues]
                self.signalMessage(*messages)
                for queue in self.queues:
                    del queue[each]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on one message of each filter if their times are less than `slop` (s) apart.

    With `sync_arrival_time` or `allow_headerless` the time of arrival is used.
    """

    def __init__(
        self,
        fs: list[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
        sync_arrival_time: bool = False,
    ) -> None:
        super().__init__(fs, queue_size)
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless
        self.sync_arrival_time = sync_arrival_time

    def add(self, msg: object, my_queue: Queue, my_queue_index: int | None = None) -> None:
        """Add a message of one filter."""
        by_arrival = self.sync_arrival_time
        stamp = stamp_of(None if by_arrival else msg, self.allow_headerless or by_arrival, "approx")
        if stamp is None:
            return
        with self.lock:
            self._keep(stamp.nanoseconds, msg, my_queue)
            if stamp.nanoseconds in my_queue:  # unless it was the oldest one in a full queue
                mine = next(index for index, queue in enumerate(self.queues) if queue is my_queue)
                self._pass_on(stamp.nanoseconds, mine)

    def _pass_on(self, stamp: int, mine: int) -> None:
        """Pass on the set of messages with a new one whose times are closest, if there is such a set."""
        slop = self.slop.nanoseconds
        near: list[list[int]] = []
        for index, queue in enumerate(self.queues):
            stamps = [stamp] if index == mine else [each for each in queue if abs(each - stamp) <= slop]
            if not stamps:
                return
            near.append(sorted(stamps, key=lambda each: abs(each - stamp)))
        for times in itertools.product(*near):
            if max(times) - min(times) < slop:
                messages = [queue[each] for queue, each in zip(self.queues, times, strict=True)]
                self.signalMessage(*messages)
                for queue, each in zip(self.queues, times, strict=True):
                    del queue[each]
                return
