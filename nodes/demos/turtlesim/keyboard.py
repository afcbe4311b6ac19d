"""Single key presses from the terminal, without Enter."""

from __future__ import annotations

import os
import select
import sys
import time
from types import TracebackType
from typing import Any

KEY_TIMEOUT_S = 0.1
"""Seconds to wait for a key."""


class NoKeyboard(Exception):
    """Standard input is not a terminal."""


class Keyboard:
    """Reads keys as they are pressed, without echo; a context manager, which may raise `NoKeyboard` on entry."""

    def __enter__(self) -> Keyboard:
        if sys.stdin is None or not sys.stdin.isatty():
            raise NoKeyboard
        if os.name != "nt":
            import termios
            import tty

            self._before: Any = termios.tcgetattr(sys.stdin.fileno())
            tty.setcbreak(sys.stdin.fileno())
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if os.name != "nt":
            import termios

            termios.tcsetattr(sys.stdin.fileno(), termios.TCSADRAIN, self._before)

    def read(self) -> str:
        """Return the next byte as a character (an arrow key takes three reads); empty if none is typed in time.

        Raises `EOFError` when the terminal is gone.
        """
        return _from_windows() if os.name == "nt" else _from_terminal(sys.stdin.fileno())


def _from_terminal(file: int) -> str:
    if not select.select([file], [], [], KEY_TIMEOUT_S)[0]:
        return ""
    byte = os.read(file, 1)
    if not byte:
        raise EOFError
    return byte.decode("latin-1")


WINDOWS_ARROWS = {"H": "A", "P": "B", "M": "C", "K": "D"}
"""The final characters of a terminal's arrow keys, by the second characters of those of Windows."""


def _from_windows() -> str:
    keys: Any = __import__("msvcrt")  # a type checker does not know its functions on other systems
    if not keys.kbhit():
        time.sleep(KEY_TIMEOUT_S)
        return ""
    key = keys.getwch()
    return WINDOWS_ARROWS.get(keys.getwch(), "") if key in ("\x00", "\xe0") else key
