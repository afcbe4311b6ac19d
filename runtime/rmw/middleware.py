"""Which middleware the contexts of this process use: the bus within the process, unless the program chose another."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import local_bus

BusOf = Callable[[int], Bus]
"""Gives the bus of a ROS domain, each time the same one."""

_bus_of: BusOf = local_bus


def choose_middleware(bus_of: BusOf) -> None:
    """Let contexts that are initialised from now on use another middleware; for the program's composition alone."""
    global _bus_of
    _bus_of = bus_of


def is_chosen(bus_of: BusOf) -> bool:
    """Whether contexts get their bus from this one."""
    return _bus_of is bus_of


def bus_of(domain: int) -> Bus:
    """The bus of a ROS domain, of the middleware that was chosen."""
    return _bus_of(domain)
