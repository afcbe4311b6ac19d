"""The thread that reads keys from the terminal, in place of Textual's own (8.2).

It notices at once keys that stop the robot, and ends as soon as it is asked to. Textual's thread checks only ten times
a second whether it should end, and then waits once more for input, which delays quitting by 0.1 to 0.2 s.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import threading
import time
from collections.abc import Iterable
from functools import partial
from types import FrameType
from typing import Any, Protocol

from bot_console.tui.keys.input_queue import InputQueue
from bot_console.tui.keys.terminal_events import TerminalEvents
from bot_console.tui.terminal.private_descriptor import private_duplicate
from textual import events
from textual.geometry import Size
from textual.message import Message

ESCAPE_TIMEOUT_S = 0.1
"""Seconds between two checks whether the thread should end, if it cannot be woken."""
READ_BYTES = 4096
"""Bytes that the kernel buffers for a terminal."""
MAX_READ_BYTES = 65536
"""Bytes that are read before the keys in them are passed on."""
INPUT = (events.InputEvent, events.Resize, events.AppFocus, events.AppBlur)


class WakeableEvent(threading.Event):
    """An event that also wakes a thread waiting for a descriptor; if no descriptors are free, it has to be polled."""

    def __init__(self) -> None:
        super().__init__()
        self._ends: list[int] = []
        with contextlib.suppress(OSError):
            for end in os.pipe():
                self._ends.append(private_duplicate(end))
                os.close(end)
            os.set_blocking(self._ends[1], False)

    def set(self) -> None:
        """Set the event and wake the waiting thread."""
        super().set()
        with contextlib.suppress(OSError, IndexError):
            os.write(self._ends[1], b"\0")

    def clear(self) -> None:
        """Clear the event."""
        super().clear()
        with contextlib.suppress(OSError, IndexError):
            while select.select(self._ends[:1], [], [], 0)[0] and os.read(self._ends[0], READ_BYTES):
                pass

    def readable(self, descriptor: int, seconds: float) -> bool:
        """Wait until a descriptor is readable, the event is set or the time is over; returns whether it is readable."""
        try:
            ready, _, _ = select.select([descriptor, *self._ends[:1]], [], [], seconds)
        except (OSError, ValueError):  # other code in this process has closed our descriptor, or all of them
            self._ends.clear()
            ready, _, _ = select.select([descriptor], [], [], seconds)
        return descriptor in ready


class StopKeyWatch(Protocol):
    """Receives keys that stop the robot, in the thread that reads them."""

    @property
    def due(self) -> float | None:
        """When to call `poll`, by `time.monotonic`; None if not at all."""
        ...

    def is_stop(self, event: events.Key) -> bool:
        """Whether a key may stop the robot."""
        ...

    def typed(self, event: events.Key, *, alone: bool) -> None:
        """Note a stop key before it is passed on; `alone` says whether nothing was read before it."""
        ...

    def poll(self) -> None:
        """Act on the keys that are due."""
        ...


class NoStopKeyWatch:
    """A `StopKeyWatch` without keys that stop the robot."""

    due = None

    def is_stop(self, event: events.Key) -> bool:
        """Always False."""
        return False

    def typed(self, event: events.Key, *, alone: bool) -> None:
        """Do nothing."""

    def poll(self) -> None:
        """Do nothing."""


def install_input_thread(driver: Any, app: Any, watch: StopKeyWatch) -> InputQueue:
    """Make Textual's Linux driver read in our thread, and merge input that is not handled in time."""
    driver.exit_event = ending = WakeableEvent()
    queue = InputQueue(app, driver._loop)
    driver.run_input_thread = partial(read_keys, driver, ending, watch)
    send, start = driver.send_message, driver.start_application_mode

    def pass_on(message: Message) -> None:
        # Replies of the terminal are not input: they say when it can take more output, and must not wait.
        (queue.put if isinstance(message, INPUT) else send)(message)

    def signalled(number: int, frame: FrameType | None) -> None:
        if not driver._in_band_window_resize:  # else the terminal reports it itself
            queue.resized(size_now)

    def size_now() -> events.Resize:
        size = Size(*driver._get_terminal_size())
        return events.Resize(size, size)

    def start_with_resizes() -> None:
        start()
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGWINCH, signalled)

    driver.send_message, driver.start_application_mode = pass_on, start_with_resizes
    return queue


def read_keys(driver: Any, ending: WakeableEvent, watch: StopKeyWatch) -> None:
    """Pass on input until asked to end, or until the terminal closes.

    Bytes that are not UTF-8 become replacement characters.
    """
    source = TerminalEvents(driver._debug, watch.is_stop, lambda event, alone: watch.typed(event, alone=alone))
    while not ending.is_set():
        now = time.monotonic()
        due = min((each for each in (source.due, watch.due) if each is not None), default=now + ESCAPE_TIMEOUT_S)
        if ending.readable(driver.fileno, max(0.0, min(ESCAPE_TIMEOUT_S, due - now))):
            typed = _read(driver.fileno)
            if typed is None:  # the terminal is gone, and would stay readable forever
                break
            _forward(driver, source.feed(typed, time.monotonic()))
        _forward(driver, source.expire(time.monotonic()))
        watch.poll()


def _read(descriptor: int) -> bytes | None:
    """Read all that was typed, so that a key is noticed behind any other input; None at the end of file."""
    typed = b""
    # the terminal was made non-blocking, and another process has read the input
    with contextlib.suppress(BlockingIOError):
        while len(typed) < MAX_READ_BYTES and (not typed or select.select([descriptor], [], [], 0)[0]):
            read = os.read(descriptor, READ_BYTES)
            if not read:
                return typed or None
            typed += read
    return typed


def _forward(driver: Any, messages: Iterable[Message]) -> None:
    for message in messages:
        driver.process_message(message)
