"""The threads in which Zenoh makes links, and how one of them is kept free to serve a new link's socket.

A new link first carries all declarations of its process, about 4 kB for each node. The thread that makes the link
writes them, and waits while the link is full. By default only this thread can notice that the socket accepts more, so
it waited for itself until the link was cut (`WAIT_BEFORE_CUT_US`) and made again: programs of 100 nodes and more were
only intermittently visible to others. A second thread of the same pool serves the socket instead, but it has to be
woken.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager

from bot_console.runtime.process.virtual.child_threads import start_outside

VARIABLE = "ZENOH_RUNTIME"
"""Environment variable from which Zenoh takes the number of its threads, when a process opens its first session."""

THREADS = "(acc: (handover: net), net: (worker_threads: 8))"
"""One pool makes the links, both those this process accepts and those it opens. All but one of its threads may wait for
room on a link at the same time; with two pools of two threads, links were still cut.
"""


@contextmanager
def link_threads() -> Generator[None]:
    """Choose the threads of the session to be opened, unless the user has; programs started later do not inherit it."""
    if VARIABLE in os.environ:
        yield
        return
    os.environ[VARIABLE] = THREADS
    try:
        yield
    finally:
        os.environ.pop(VARIABLE, None)


class LinkWaker:
    """Calls `wake`, which must wake an idle thread of the pool, for each new link; runs in a separate thread."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._has_new_link, self._has_ended = threading.Event(), False
        thread = threading.Thread(target=self._run, name="zenoh-links", daemon=True)
        thread.pydev_do_not_trace = True  # pyright: ignore[reportAttributeAccessIssue] -- debugpy must not stop it
        start_outside(thread)

    def link_changed(self, zid: str, there: bool) -> None:
        """A link is being made (True) or was lost; called on one of Zenoh's threads."""
        if there:
            self._has_new_link.set()

    def end(self) -> None:
        """Stop the thread."""
        self._has_ended = True
        self._has_new_link.set()

    def _run(self) -> None:
        while self._has_new_link.wait() and not self._has_ended:
            self._has_new_link.clear()
            self._wake()
