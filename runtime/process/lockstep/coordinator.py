"""The process that owns the simulated time of a stepped run in which other processes take part."""

from __future__ import annotations

import os
from weakref import WeakKeyDictionary

from ..clock_source import ClockSource
from ..stepping.stepped_time import SteppedTime
from .channel import Welcome
from .seat import ProcessSeat, Relay


class Coordinator:
    """The processes of one run."""

    def __init__(self, clock: SteppedTime, relay: Relay, seed: int) -> None:
        self._clock = clock
        self._relay = relay
        self._seed = seed
        self._seats: list[ProcessSeat] = []
        _coordinators[clock] = self

    def seat(self, name: str) -> ProcessSeat:
        """Make a seat for a new process."""
        number = len(self._seats) + 1
        pinned = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
        welcome = Welcome(self._clock.system_offset, self._clock.stall_s, self._seed << 16 | number, pinned)
        seat = ProcessSeat(self._clock, name, number, welcome, self._relay)
        self._seats.append(seat)
        return seat

    def close(self) -> None:
        """End the processes that still run, at the end of the run."""
        for each in self._seats:
            each.close()


_coordinators: WeakKeyDictionary[ClockSource, Coordinator] = WeakKeyDictionary()


def coordinator_of(clock: ClockSource) -> Coordinator | None:
    """Return the coordinator of a run; None if no other process takes part in it."""
    return _coordinators.get(clock)
