"""How a verb reaches the system that it is asked about: in its domain, or through the routers that are named."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bot_console.tui.cli.system.domain import CONNECT_VARIABLE, take_part

if TYPE_CHECKING:
    from bot_console.runtime.rmw.bus import Bus


def reach_system() -> str:
    """Take part in the domain of this machine, or be a client of the robot's router that the environment names."""
    endpoints = os.environ.get(CONNECT_VARIABLE, "").split()
    if not endpoints:
        return take_part()
    from bot_console.tui.cli.system.connecting import connect_to

    return connect_to(endpoints)


def reach_when_asked() -> None:
    """Reach it with the first context, for a verb that seldom makes one; where that cannot be, the verb is alone."""
    from bot_console.runtime.rmw.local import local_bus
    from bot_console.runtime.rmw.middleware import bus_of, choose_middleware

    def reach(domain: int) -> Bus:
        if reach_system():
            choose_middleware(local_bus)
        return bus_of(domain)

    choose_middleware(reach)
