"""The bus of a program that is connected to a robot's router, one for each ROS domain."""

from __future__ import annotations

import threading

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import LocalBus
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.link_probe import LinkState
from bot_console.runtime.rmw.zenoh.network.client import NetworkSession, Way, open_network_session


class NetworkBuses:
    """Gives the bus of a domain; to be given to `choose_middleware`. Raises what `open_network_session` raises."""

    def __init__(self, way: Way) -> None:
        self._way = way
        self._lock = threading.Lock()
        self._open: dict[int, tuple[NetworkSession, ZenohBus]] = {}

    def __call__(self, domain: int) -> Bus:
        """The bus of a domain, made at first use."""
        with self._lock:
            if domain not in self._open:
                session = open_network_session(domain, self._way)
                session.watch()
                self._open[domain] = session, ZenohBus(session, LocalBus())
            return self._open[domain][1]

    def link(self) -> LinkState:
        """How the link is."""
        with self._lock:
            states = [session.link for session, _ in self._open.values()]
        return min(states, key=lambda each: each.heard or 0.0, default=LinkState(str(self._way)))

    def close(self) -> None:
        """Hang up."""
        with self._lock:
            opened, self._open = list(self._open.values()), {}
        for _, bus in opened:
            bus.close()
