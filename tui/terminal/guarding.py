"""A guardian beside the console, see `guardian`."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import termios
from collections.abc import Callable, Generator
from pathlib import Path

from bot_console.tui.terminal import guardian


@contextlib.contextmanager
def guarded(terminal: int) -> Generator[Callable[[], None]]:
    """Have the terminal put right after the block, however this process ends; to be called once it is set for us."""
    try:
        process = subprocess.Popen(
            [sys.executable, "-I", "-S", str(Path(guardian.__file__)), str(terminal)], pass_fds=[terminal],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
    except OSError:  # no process can be started: go on without
        yield lambda: None
        return
    assert process.stdin is not None
    pipe = process.stdin.fileno()

    def tell(line: str) -> None:
        with contextlib.suppress(OSError):
            os.write(pipe, f"{line}\n".encode())

    def has_begun() -> None:
        with contextlib.suppress(termios.error):
            tell(json.dumps(guardian.settings_of(terminal)))

    has_begun()
    try:
        yield has_begun
    finally:
        tell(guardian.WELL)
        with contextlib.suppress(OSError):
            process.stdin.close()
        process.wait()
