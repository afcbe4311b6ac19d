"""Reads single keys from the terminal, for programs that print lines."""

from __future__ import annotations

import os
import select
import sys
import termios
import threading
import tty
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager

KEYS = {
    b"\x1b[A": "up", b"\x1b[B": "down", b"\x1b[C": "right", b"\x1b[D": "left", b"\x1bOA": "up", b"\x1bOB": "down",
    b"\x1bOC": "right", b"\x1bOD": "left", b"\x1b[5~": "pageup", b"\x1b[6~": "pagedown", b"\x1b[H": "home",
    b"\x1bOH": "home", b"\x1b[1~": "home", b" ": "space",
}  # fmt: skip
POLL_S = 0.2


@contextmanager
def read_keys(pressed: Callable[[str], None]) -> Generator[bool]:
    """Call `pressed` from a thread for every key while the block runs; yields whether there is a terminal to read.

    A program in the background does not touch the terminal: reading from it would stop the program.
    """
    number = sys.stdin.fileno() if sys.stdin is not None and sys.stdin.isatty() else -1
    if number < 0 or os.tcgetpgrp(number) != os.getpgrp():
        yield False
        return
    before = termios.tcgetattr(number)
    ended = threading.Event()

    def read() -> None:
        while not ended.is_set():
            if select.select([number], [], [], POLL_S)[0]:
                data = os.read(number, 64)
                if not data:
                    return
                for key in split_keys(data):
                    pressed(key)

    thread = threading.Thread(target=read, name="keyboard", daemon=True)
    try:
        tty.setcbreak(number, termios.TCSADRAIN)
        thread.start()
        yield True
    finally:
        ended.set()
        termios.tcsetattr(number, termios.TCSADRAIN, before)


def split_keys(data: bytes) -> Iterator[str]:
    """Split bytes that were read together into keys; unknown ones are dropped."""
    while data:
        known = next((each for each in KEYS if data.startswith(each)), b"")
        if known:
            yield KEYS[known]
            data = data[len(known) :]
        elif data.startswith(b"\x1b"):
            return
        else:
            yield data[:1].decode("latin-1")
            data = data[1:]
