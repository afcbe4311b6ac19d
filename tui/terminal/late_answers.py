"""Reads the answers that the terminal still owes when the app leaves it; the shell would take them for typed text."""

from __future__ import annotations

import os
import select
import time
from collections.abc import Callable
from typing import Any

STATUS_QUESTION = "\x1b[5n"
STATUS = b"\x1b[0n"
"""The answer to `STATUS_QUESTION`. A terminal answers in order, so all earlier answers come before it."""
LATE_ANSWERS_S = 0.8
"""Seconds to wait for `STATUS`; less than `closing` allows for the remaining output."""


def read_late_answers(driver: Any, owes: Callable[[], bool]) -> None:
    """Make Textual's Linux driver read the answers that the terminal still owes before it leaves the terminal."""
    leave = driver.stop_application_mode

    def stop() -> None:
        if owes():
            driver.disable_input()  # ends the input thread, which would take the answers
            driver.write(STATUS_QUESTION)
            _read_until(driver.fileno, STATUS, time.monotonic() + LATE_ANSWERS_S)
        leave()

    driver.stop_application_mode = stop


def _read_until(descriptor: int, last: bytes, deadline: float) -> None:
    read = b""
    while last not in read and (left := deadline - time.monotonic()) > 0:
        try:
            if not select.select([descriptor], [], [], left)[0]:
                return
            piece = os.read(descriptor, 4096)
        except (OSError, ValueError):  # the terminal is gone
            return
        if not piece:
            return
        read = read[-len(last) :] + piece
