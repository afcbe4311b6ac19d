"""The bus of the processes of a stepped run, one per ROS domain."""

from __future__ import annotations

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.lockstep.session import Link, LockstepSession
from bot_console.runtime.rmw.lockstep.switchboard import Operation
from bot_console.runtime.rmw.zenoh.bus import ZenohBus


class LockstepBuses:
    """A process's buses. `of` is an argument for `choose_middleware`."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._buses: dict[int, _LockstepBus] = {}
        self._reported = 0

    def of(self, domain: int) -> Bus:
        """Return the bus of a domain, created on first use."""
        if domain not in self._buses:
            self._buses[domain] = _LockstepBus(domain, self._link)
        return self._buses[domain]

    def news(self) -> list[Operation]:
        """Return what the switchboard must be told at the end of a turn: how many messages have been published."""
        published = sum(each.published_here() for each in self._buses.values())
        if published == self._reported:
            return []
        self._reported = published
        return [("published", published)]


class _LockstepBus(ZenohBus):
    def __init__(self, domain: int, link: Link) -> None:
        super().__init__(LockstepSession(domain, link), local_bus(domain))
        self._link = link

    def published_here(self) -> int:
        """Number of messages published by the current publishers of this process."""
        return super().published()

    def published(self) -> int:
        """Number of messages published by the current publishers; in the coordinator, by those of all processes."""
        return self.published_here() + self._link.published_elsewhere()
