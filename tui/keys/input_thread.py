"""The thread that reads keys from the terminal, as Textual's own (8.2) does, but which ends at once when told to.

Textual's checks ten times a second whether it should end, and once more with nothing to read: quitting took it 0.1 to
0.2 s.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import select
import threading
from codecs import getincrementaldecoder
from functools import partial
from typing import Any

from bot_console.tui.keys.escape_parser import EscapeParser
from bot_console.tui.keys.pasted import Pasted
from textual._parser import ParseError

LOOK = 0.1
"""Seconds after which a lone Esc is looked at again: it may have begun a sequence."""
AT_ONCE = 4096
"""Bytes that are read at a time."""
FIRST = 100
"""Our descriptors begin here, beyond those that programs close or count."""


class Ending(threading.Event):
    """An event that also wakes a thread waiting for a descriptor; where descriptors run out, it is polled."""

    def __init__(self) -> None:
        super().__init__()
        self._ends: list[int] = []
        with contextlib.suppress(OSError):
            for end in os.pipe():
                self._ends.append(fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, FIRST))
                os.close(end)
            os.set_blocking(self._ends[1], False)

    def set(self) -> None:
        """Set it, and wake."""
        super().set()
        with contextlib.suppress(OSError, IndexError):
            os.write(self._ends[1], b"\0")

    def clear(self) -> None:
        """Wake nobody any more."""
        super().clear()
        with contextlib.suppress(OSError, IndexError):
            while select.select(self._ends[:1], [], [], 0)[0] and os.read(self._ends[0], AT_ONCE):
                pass

    def readable(self, descriptor: int, seconds: float) -> bool:
        """Wait until a descriptor can be read, the event is set or the time is over; whether it can be read."""
        try:
            ready, _, _ = select.select([descriptor, *self._ends[:1]], [], [], seconds)
        except (OSError, ValueError):  # a program in this process has closed ours, or those of everybody
            self._ends.clear()
            ready, _, _ = select.select([descriptor], [], [], seconds)
        return descriptor in ready


def ends_at_once(driver: Any) -> None:
    """Make a Linux driver of Textual read keys in a thread that ends as soon as it is told to."""
    driver.exit_event = ending = Ending()
    driver.run_input_thread = partial(take_keys, driver, ending)


def take_keys(driver: Any, ending: Ending) -> None:
    """Pass on what is typed until told to end, or until the terminal closes.

    Bytes that are not text are shown as such.
    """
    parser: Any = EscapeParser(driver._debug)
    pasted = Pasted()
    decode = getincrementaldecoder("utf-8")("replace").decode
    while not ending.is_set():
        if ending.readable(driver.fileno, LOOK):
            try:
                typed = os.read(driver.fileno, AT_ONCE)
            except BlockingIOError:  # somebody has made the terminal not to block, and has taken what there was
                continue
            if not typed:  # the terminal is gone, and would be readable for good
                break
            if text := decode(typed):
                _hand_on(driver, parser.feed(pasted.without_escapes(text)))
        _hand_on(driver, parser.tick())
    with contextlib.suppress(EOFError, ParseError):
        for _ in parser.feed(""):
            pass


def _hand_on(driver: Any, events: Any) -> None:
    for event in events:
        driver.process_message(event)
