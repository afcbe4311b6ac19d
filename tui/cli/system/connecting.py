"""A program as a client of a robot's router, without a screen."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.runtime.importer import install
from bot_console.runtime.rmw.middleware import bus_of, choose_middleware
from bot_console.runtime.rmw.zenoh.network.client import Way, with_environment
from bot_console.runtime.rmw.zenoh.network.network_bus import NetworkBuses
from bot_console.runtime.rmw.zenoh.network.reach import place_of
from bot_console.runtime.rmw.zenoh.session import SessionError
from bot_console.tui.cli.system.domain import domain


def connect(way: Way) -> NetworkBuses:
    """Let the contexts of this process be clients of a router from now on; raises `SessionError` with the reason."""
    install()
    buses = NetworkBuses(with_environment(way))
    choose_middleware(buses)
    bus_of(domain())  # now, so that it is told before there is a screen
    return buses


def connect_to(endpoints: Sequence[str]) -> str:
    """Be a client of these routers; gives why that cannot be, in one line, empty where it can."""
    try:
        for each in endpoints:
            place_of(each)
        connect(Way(tuple(endpoints)))
    except (SessionError, ValueError) as error:
        return str(error)
    return ""
