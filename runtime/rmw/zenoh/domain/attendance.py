"""Which processes are in a domain, determined before a short-lived program reports on the graph."""

from __future__ import annotations

import os
import threading
import time

from bot_console.runtime.rmw.zenoh.domain.sockets import Socket, lives
from bot_console.runtime.rmw.zenoh.session import Session

PATIENCE = 0.3
"""How long the others have to answer, in s; a running one takes 5 ms."""


def await_answers(session: Session, patience: float = PATIENCE) -> list[Socket]:
    """Wait until each process that was there when the session joined has answered; returns those that did not.

    An answer shows that the link carries questions, which a link that was just made does not yet: only after it does
    one question for the graph bring all of it. Frozen processes are not waited for.
    """
    deadline = time.monotonic() + patience
    missing = list(session.joined)
    while missing:
        answered = session.attendance()
        missing = [each for each in missing if each.zid not in answered and _runs(each)]
        if all(each.is_stopped() for each in missing) or time.monotonic() > deadline:
            break
        threading.Event().wait(0.002)
    return missing


def _runs(socket: Socket) -> bool:
    """Whether its process has neither left nor been killed."""
    if not os.path.lexists(socket.path):
        return False
    return lives(socket.pid)
