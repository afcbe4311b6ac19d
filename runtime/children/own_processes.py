"""The fork server of this process, and the first steps of each process forked from it.

It imports little: a program that will need processes starts the server first, which warms up while the rest is
imported.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from typing import Any

from bot_console.runtime.process.fork_server import ForkServer, function_named

CAN_FORK = hasattr(os, "fork")
WARM_UP = "bot_console.runtime.children.warm_up:warm_up"
PREPARE = "bot_console.runtime.children.import_prefetch:import_needed"
MEMBER_PROGRAM = "bot_console.runtime.rmw.lockstep.member_program:member_program"
"""The function of jobs whose process takes part in a stepped run; named only, as launch does not depend on rmw."""

_guard = threading.Lock()
_beginnings: list[str] = []
_servers: list[ForkServer] = []


def fork_server() -> ForkServer:
    """Return the fork server of this process, started on first use and restarted if it was killed."""
    with _guard:
        if not _servers or not _servers[0].is_alive:
            _servers[:] = [ForkServer(WARM_UP, PREPARE)]
        return _servers[0]


def fork_off_server() -> None:
    """Start the fork server as a fork of this process, which has just begun: it has one thread and no session."""
    _servers[:] = [ForkServer(WARM_UP, PREPARE, from_here=True)]  # without the lock, which would be held in the fork


def close_fork_server() -> None:
    """End the server and all its children; waits for that."""
    with _guard:
        servers, _servers[:] = list(_servers), []
    for each in servers:
        each.close()


def begin_children_with(function: str) -> None:
    """Make each child process call `package.module:function` before anything else, for instance to choose its
    middleware.
    """
    if function not in _beginnings:
        _beginnings.append(function)


def beginnings() -> list[str]:
    """Return the functions that each child process calls first."""
    return list(_beginnings)


def begun(called: Sequence[str], function: str, arguments: Sequence[Any]) -> Callable[[], object]:
    """In the child process: return what to run, after calling the functions that come first."""
    for each in called:
        function_named(each)()
    return function_named(function)(*arguments)
