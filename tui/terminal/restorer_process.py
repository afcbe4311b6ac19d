"""Starts `restorer` as a process beside the console."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import termios
from collections.abc import Callable, Generator
from pathlib import Path
from typing import NamedTuple

from bot_console.tui.terminal import restorer


class Restorer(NamedTuple):
    """The process that restores the terminal, by the notices it is sent: calling one sends it."""

    has_begun: Callable[[], None]
    """The terminal is set for us."""
    has_ended: Callable[[], None]
    """The terminal is as it was: the restorer goes, while this process does what else there is to do at its end."""


@contextlib.contextmanager
def restored_terminal(terminal: int) -> Generator[Restorer]:
    """Have the terminal restored after the block, however this process ends, unless told that it is right."""
    try:
        process = subprocess.Popen(
            [sys.executable, "-I", "-S", str(Path(restorer.__file__)), str(terminal)], pass_fds=[terminal],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
    except OSError:  # no process can be started: continue without
        yield Restorer(lambda: None, lambda: None)
        return
    assert process.stdin is not None
    pipe = process.stdin.fileno()

    def report(line: str) -> None:
        with contextlib.suppress(OSError):
            os.write(pipe, f"{line}\n".encode())

    def has_begun() -> None:
        with contextlib.suppress(termios.error):
            report(json.dumps(restorer.settings_of(terminal)))

    def has_ended() -> None:
        report(restorer.WELL)

    has_begun()
    try:
        yield Restorer(has_begun, has_ended)
    finally:
        has_ended()
        with contextlib.suppress(OSError):
            process.stdin.close()
        process.wait()
