"""Pseudo terminals for a child's output, so that it prints as if to a user."""

from __future__ import annotations

import os
import pty
import termios
from typing import NamedTuple


class Stream(NamedTuple):
    """Both ends of a pipe or pseudo terminal that a child prints to."""

    own_end: int
    child_end: int


def open_terminals() -> tuple[Stream, Stream]:
    """Open one terminal each for stdout and stderr; they leave line ends unchanged."""
    return _terminal(), _terminal()


def open_pipes() -> tuple[Stream, Stream]:
    """Open one pipe each for stdout and stderr."""
    return Stream(*os.pipe()), Stream(*os.pipe())


def _terminal() -> Stream:
    own_end, child_end = pty.openpty()
    settings = termios.tcgetattr(child_end)
    settings[1] &= ~termios.ONLCR
    termios.tcsetattr(child_end, termios.TCSANOW, settings)
    return Stream(own_end, child_end)
