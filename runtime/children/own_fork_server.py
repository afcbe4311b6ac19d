"""The fork server of this process, and the first steps of each process forked from it.

It imports little: a program that will need processes starts the server first, and it warms up while the program imports
the rest.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence

from bot_console.runtime.process.fork_server import ForkServer, function_named

CAN_FORK = hasattr(os, "fork")
WARM_UP = "bot_console.runtime.children.warm_up:warm_up"
PREPARE = "bot_console.runtime.children.import_prefetch:import_needed"
MEMBER_PROGRAM = "bot_console.runtime.rmw.lockstep.member_program:member_program"
"""The function of jobs whose process takes part in a stepped run; not imported, as launch does not depend on rmw."""
SHARE = "bot_console.runtime.rmw.zenoh.domain.domain_bus:share_domains"
"""The first function that a process calls to join the domain; not imported, for the same reason."""

_guard = threading.Lock()
_servers: list[ForkServer] = []


def fork_server() -> ForkServer:
    """Return the fork server of this process, started on first use and restarted if it was killed."""
    with _guard:
        if not _servers or not _servers[0].is_alive:
            _servers[:] = [ForkServer(WARM_UP, PREPARE)]
        return _servers[0]


def fork_off_server() -> None:
    """Start the fork server as a fork of this process, which has just begun: it has one thread and no session yet."""
    _servers[:] = [ForkServer(WARM_UP, PREPARE, from_here=True)]  # without the lock: the fork would hold it for ever


def close_fork_server() -> None:
    """End the server and all its children, and wait for that."""
    with _guard:
        servers, _servers[:] = list(_servers), []
    for each in servers:
        each.close()


def begun(joins: bool, function: str, arguments: Sequence[object]) -> Callable[[], object]:
    """In the child process, return the program to run, after joining the domain if the program `joins` it."""
    if joins:
        function_named(SHARE)()
    return function_named(function)(*arguments)
