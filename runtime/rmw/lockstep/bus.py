"""The bus of the processes of a stepped run, one per ROS domain."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.lockstep.session import Link, LockstepSession
from bot_console.runtime.rmw.zenoh.bus import ZenohBus


def bus_over(link: Link) -> Callable[[int], Bus]:
    """Return a function for `choose_middleware`: the bus of a domain, created on first use."""
    buses: dict[int, ZenohBus] = {}

    def bus_of(domain: int) -> Bus:
        if domain not in buses:
            buses[domain] = ZenohBus(LockstepSession(domain, link), local_bus(domain))
        return buses[domain]

    return bus_of
