"""The bus that the processes of a user share, one for each ROS domain."""

from __future__ import annotations

import atexit
import threading
from typing import TYPE_CHECKING

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.middleware import choose_middleware, is_chosen
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.bus import ZenohBus

_buses: dict[int, ZenohBus] = {}
_lock = threading.Lock()


def shared_bus(domain: int) -> Bus:
    """The bus of a domain, made at first use; the one within this process where the range of discovery is OFF.

    To be given to `choose_middleware`. Raises what `open_session` raises.
    """
    if not is_in_range():
        return local_bus(domain)
    with _lock:
        if domain not in _buses:
            # Here, as a launch all of whose nodes are processes of their own opens no session.
            from bot_console.runtime.rmw.zenoh.bus import ZenohBus
            from bot_console.runtime.rmw.zenoh.domain.mesh import open_session

            session = open_session(domain)
            session.watch()
            _buses[domain] = ZenohBus(session, local_bus(domain))
        return _buses[domain]


def share_domains() -> None:
    """Let the contexts of this process that are initialised from now on share their domain; leave it at the end."""
    if not is_chosen(shared_bus):
        choose_middleware(shared_bus)
        atexit.register(leave_all)


def close_shared_buses() -> None:
    """Leave all domains; contexts that still use their bus are not heard any more."""
    with _lock:
        for bus in _buses.values():
            bus.close()
        _buses.clear()


def leave_all() -> None:
    """Take this process's sockets away, for one that ends at once and does not wait until its sessions are closed."""
    with _lock:
        for bus in _buses.values():
            bus.leave()
