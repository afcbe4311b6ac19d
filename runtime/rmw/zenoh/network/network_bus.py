"""The bus of a program connected to a robot's router, one per ROS domain."""

from __future__ import annotations

import threading

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import LocalBus
from bot_console.runtime.rmw.qos_matching import RMW_ZENOH
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.link_probe import LinkState
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, NetworkSession, open_network_session
from bot_console.runtime.rmw.zenoh.network.other_domains import other_domains


class NetworkBuses:
    """Returns the bus of a domain; an argument for `choose_middleware`. Raises what `open_network_session` raises."""

    def __init__(self, config: ClientConfig) -> None:
        self._config = config
        self._lock = threading.Lock()
        self._open: dict[int, tuple[NetworkSession, ZenohBus]] = {}

    def __call__(self, domain: int) -> Bus:
        """Return the bus of a domain, created on first use."""
        with self._lock:
            if domain not in self._open:
                session = open_network_session(domain, self._config)
                session.watch()
                self._open[domain] = session, ZenohBus(session, LocalBus(RMW_ZENOH))
            return self._open[domain][1]

    def link(self) -> LinkState:
        """Return the state of the link; if there are several, of the one that has been silent longest."""
        with self._lock:
            states = [session.link for session, _ in self._open.values()]
        return min(states, key=lambda each: each.last_answer or 0.0, default=LinkState(str(self._config)))

    def other_domains(self, domain: int) -> str:
        """Return, in one line, the router's domains that have nodes if this one has none; otherwise empty."""
        with self._lock:
            opened = self._open.get(domain)
        return other_domains(opened[0]) if opened else ""

    def close(self) -> None:
        """Close all sessions."""
        with self._lock:
            opened, self._open = list(self._open.values()), {}
        for _, bus in opened:
            bus.close()
