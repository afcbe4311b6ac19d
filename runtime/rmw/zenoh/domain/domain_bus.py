"""The bus shared by a user's processes, one per ROS domain."""

from __future__ import annotations

import atexit
import threading
from typing import TYPE_CHECKING

from bot_console.runtime.process.current import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.process.unpatched import getpid
from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.middleware import choose_middleware, is_chosen
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.bus import ZenohBus

FORKED = (
    "this process was forked from one that had called rclpy.init: no message leaves it. Fork before rclpy.init, or "
    "start it with multiprocessing.get_context('spawn')"
)
_opened_by: set[int] = set()
"""The pids of processes that have opened a session: the threads of a session do not exist in forks of its process."""
_buses: dict[int, ZenohBus] = {}
_lock = threading.Lock()


def shared_bus(domain: int) -> Bus:
    """Return the bus of a domain, created on first use; the in-process bus if the discovery range is OFF.

    Meant as an argument for `choose_middleware`. Raises what `open_session` raises.
    """
    if not is_in_range():
        return local_bus(domain)
    if any(pid != getpid() for pid in _opened_by):
        notify(current(), FORKED)
    with _lock:
        if domain not in _buses:
            # Imported here because a launch whose nodes are all separate processes needs no session.
            from bot_console.runtime.rmw.zenoh.bus import ZenohBus
            from bot_console.runtime.rmw.zenoh.domain.mesh import open_session

            session = open_session(domain)
            session.watch()
            _buses[domain] = ZenohBus(session, local_bus(domain))
            _opened_by.add(getpid())
        return _buses[domain]


def share_domains() -> None:
    """Make contexts that are initialised from now on share their domain with other processes; at exit, leave it."""
    if not is_chosen(shared_bus):
        choose_middleware(shared_bus)
        atexit.register(leave_all)


def close_shared_buses() -> None:
    """Leave all domains; contexts that still use their buses can no longer reach other processes."""
    with _lock:
        for bus in _buses.values():
            bus.close()
        _buses.clear()


def leave_all() -> None:
    """Remove this process's sockets, for a process that exits at once without waiting for its sessions to close."""
    with _lock:
        for bus in _buses.values():
            bus.leave()
