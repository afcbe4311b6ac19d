"""The process that owns the simulated time of a stepped run in which other processes take part."""

from __future__ import annotations

import os
from weakref import WeakKeyDictionary

from ..clock_source import ClockSource
from ..stepping.stepped_time import SteppedTime
from .channel import Welcome
from .member_process import MemberProcess, Relay


class Coordinator:
    """The processes of one run."""

    def __init__(self, clock: SteppedTime, relay: Relay, seed: int) -> None:
        self._clock = clock
        self._relay = relay
        self._seed = seed
        self._members: list[MemberProcess] = []
        _coordinators[clock] = self

    def new_member(self, name: str) -> MemberProcess:
        """Add a process that is about to be started."""
        number = len(self._members) + 1
        pinned = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
        welcome = Welcome(self._clock.system_offset, self._clock.stall_s, self._seed << 16 | number, pinned)
        member = MemberProcess(self._clock, name, number, welcome, self._relay)
        self._members.append(member)
        return member

    def close(self) -> None:
        """End the processes that are still running, at the end of the run."""
        for each in self._members:
            each.close()


_coordinators: WeakKeyDictionary[ClockSource, Coordinator] = WeakKeyDictionary()


def coordinator_of(clock: ClockSource) -> Coordinator | None:
    """Return the coordinator of a run; None if no other process takes part in it."""
    return _coordinators.get(clock)
