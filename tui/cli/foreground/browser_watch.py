"""Ends a console that steers a robot when the browser that shows it falls silent.

A tunnel keeps its end of a connection open when the browser is gone, so that there is no hang-up. Therefore
`bot-console serve` passes on each sign of life from the page, as a byte on a descriptor that this process inherits.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import threading
import time
from collections.abc import Callable, Generator

VARIABLE = "BOT_CONSOLE_BROWSER"
"""Environment variable: the descriptor on which signs of life arrive."""
MAX_SILENCE_S = 1.0
"""Seconds of silence after which the browser of a console that steers counts as closed."""
POLL_S = 0.1


class BrowserWatch:
    """Decides from signs of life whether the browser counts as closed."""

    def __init__(self, steers: Callable[[], bool], clock: Callable[[], float] = time.monotonic) -> None:
        self._steers = steers
        self._clock = clock
        self._heard = clock()

    def hear(self) -> None:
        """Note a sign of life."""
        self._heard = self._clock()

    def is_gone(self) -> bool:
        """Whether the browser counts as closed."""
        return self._steers() and self._clock() - self._heard > MAX_SILENCE_S


@contextlib.contextmanager
def browser_watch(steers: Callable[[], bool]) -> Generator[None]:
    """Raise SIGHUP in this process when the browser that shows it counts as closed; without a browser, do nothing."""
    text = os.environ.pop(VARIABLE, "")  # Programs that the console starts have no browser.
    if not text.isdigit():
        yield
        return
    descriptor, over = int(text), threading.Event()
    os.set_inheritable(descriptor, False)
    args = (BrowserWatch(steers), descriptor, over)
    threading.Thread(target=_watch, args=args, name="browser", daemon=True).start()
    try:
        yield
    finally:
        over.set()


def _watch(watch: BrowserWatch, descriptor: int, over: threading.Event) -> None:
    poller = select.poll()
    poller.register(descriptor, select.POLLIN)
    while not over.is_set():
        # Read what has arrived before judging the silence, since this process itself may have been held up.
        if poller.poll(POLL_S * 1000):
            if not os.read(descriptor, 4096):
                break
            watch.hear()
        elif watch.is_gone():
            break
    if not over.is_set():
        os.kill(os.getpid(), signal.SIGHUP)
