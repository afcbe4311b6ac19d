"""Find out which processes are in a domain, before a short-lived program reports on the graph."""

from __future__ import annotations

import os
import threading
import time

from bot_console.runtime.rmw.zenoh.domain.sockets import Socket, process_exists
from bot_console.runtime.rmw.zenoh.session import Session


def await_answers(session: Session, timeout_s: float) -> list[Socket]:
    """Wait until each process that existed when the session joined has answered; return those that have not.

    An answer proves that the link carries queries, which a new link cannot do at once; only then does a single graph
    query return the whole graph. A running process takes 5 ms, one of 400 nodes 0.4 s; frozen processes are not waited
    for.
    """
    deadline = time.monotonic() + timeout_s
    missing = list(session.joined)
    while missing:
        answered = session.answering_sessions()
        missing = [each for each in missing if each.zid not in answered and _runs(each)]
        if all(each.is_stopped() for each in missing) or time.monotonic() > deadline:
            break
        threading.Event().wait(0.002)
    return missing


def _runs(socket: Socket) -> bool:
    """Whether the socket's process has neither left nor been killed."""
    if not os.path.lexists(socket.path):
        return False
    return process_exists(socket.pid)
