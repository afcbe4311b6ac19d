"""Gives the console private descriptors for its terminal.

Output that C libraries write to descriptors 1 and 2, bypassing Python, becomes lines of the log instead of damaging the
screen. Code that closes or redirects descriptors 0, 1 and 2 affects neither keys nor screen, and a child that inherits
them cannot read the keys.
"""

from __future__ import annotations

import contextlib
import os
import select
import sys
import threading
from collections.abc import Callable, Generator, Iterator
from typing import IO

from bot_console.tui.terminal.private_descriptor import private_duplicate

Printed = Callable[[int, str, str], None]
LABEL = "stderr"
MAX_LINE_BYTES = 1 << 16
"""Bytes after which an unterminated line is logged as it is."""
DRAIN_TIMEOUT_S = 10.0
"""Maximum seconds that the end waits until all lines written before it are in the log."""
MAX_PIPE_BYTES = 1 << 20
"""The maximum capacity of a pipe on Linux, unless root has raised it."""


@contextlib.contextmanager
def captured_descriptors(printed: Printed) -> Generator[None]:
    """Give the screen duplicates of descriptors 0, 1 and 2, and pass lines written to 1 and 2 to `printed`.

    While the app runs, it reads and writes through `sys.__stdin__`, `sys.__stdout__` and `sys.__stderr__`, which are
    the duplicates.
    """
    with contextlib.ExitStack() as stack:
        stack.enter_context(_private_stdin())
        for number, name in ((1, "__stdout__"), (2, "__stderr__")):
            stack.enter_context(_captured_output(number, name, printed))
        yield


@contextlib.contextmanager
def _private_stdin() -> Generator[None]:
    before: IO[str] | None = sys.__stdin__
    keys = os.fdopen(private_duplicate(0), encoding="utf-8", errors="replace")
    nowhere = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nowhere, 0)
    os.close(nowhere)
    setattr(sys, "__stdin__", keys)  # noqa: B010 -- it is final for type checkers
    try:
        yield
    finally:
        setattr(sys, "__stdin__", before)  # noqa: B010 -- final for type checkers
        os.dup2(keys.fileno(), 0)
        keys.close()


@contextlib.contextmanager
def _captured_output(number: int, name: str, printed: Printed) -> Generator[None]:
    before: IO[str] | None = getattr(sys, name)
    if before is not None:
        before.flush()
    saved = private_duplicate(number)
    screen = os.fdopen(private_duplicate(number), "w", encoding="utf-8", errors="replace", newline="")
    reading, writing = os.pipe()
    os.dup2(writing, number)
    os.close(writing)
    ended, end = os.pipe()
    reader = threading.Thread(target=_report, args=(reading, ended, printed), name="descriptors", daemon=True)
    reader.start()
    setattr(sys, name, screen)
    try:
        yield
    finally:
        setattr(sys, name, before)
        with contextlib.suppress(OSError):  # The terminal may be gone.
            screen.flush()
        os.dup2(saved, number)  # closes the last writing end, unless a child of this process has one
        os.close(saved)
        os.close(end)
        reader.join(DRAIN_TIMEOUT_S)
        with contextlib.suppress(OSError):
            screen.close()


def _report(descriptor: int, ended: int, printed: Printed) -> None:
    for line in _lines(descriptor, ended):
        from bot_console.tui.console.model import Severity  # imported with the first line, since most runs have none

        printed(Severity.INFO, LABEL, line)


def _lines(descriptor: int, ended: int) -> Iterator[str]:
    rest = b""
    try:
        for data in _blocks(descriptor, ended):
            *whole, rest = (rest + data).split(b"\n")
            if len(rest) > MAX_LINE_BYTES:
                whole, rest = [*whole, rest], b""
            yield from (text for line in whole if (text := line.decode("utf-8", "replace").rstrip("\r")).strip())
        if rest.strip():
            yield rest.decode("utf-8", "replace")
    finally:
        os.close(descriptor)
        os.close(ended)


def _blocks(descriptor: int, ended: int) -> Iterator[bytes]:
    """Yield the bytes that are written until `ended` is closed, even if a child goes on writing after that."""
    readable: list[int] = []
    while ended not in readable:
        readable, _, _ = select.select([descriptor, ended], [], [])
        if descriptor in readable:
            data = os.read(descriptor, MAX_PIPE_BYTES if ended in readable else 65536)
            if not data:
                return
            yield data
