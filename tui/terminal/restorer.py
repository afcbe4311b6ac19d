"""Puts the terminal right when the console was killed (-9) or has crashed, which it cannot do itself by then.

    python -I -S restorer.py TERMINAL

`TERMINAL` is an inherited descriptor. On standard input comes, as JSON, how the terminal was before the console and,
once it has begun, how the console has set it; then a full stop when it has ended well. Standard library only.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import termios
from typing import Any, TypeAlias

Settings: TypeAlias = "list[Any]"

LAST_WORDS = (
    "\x18\x1b[m\x1b[?2026l\x1b[?1000l\x1b[?1002l\x1b[?1003l\x1b[?1006l\x1b[?1015l\x1b[?1004l\x1b[?2004l\x1b[?7h\x1b[<u"
    "\x1b[?1049l\x1b[?25h"
)
"""Ends a sequence that was cut off, then every mode that Textual has set, for when the terminal wakes up."""
WELL = "."


def settings_of(terminal: int) -> Settings:
    """The settings of a terminal, with bytes as numbers for JSON."""
    *numbers, characters = termios.tcgetattr(terminal)
    return [*numbers, [ord(each) if isinstance(each, bytes) else each for each in characters]]


def set_again(terminal: int, settings: Settings) -> None:
    """Restore the settings of a terminal."""
    *numbers, characters = settings
    canonical = numbers[3] & termios.ICANON
    as_bytes = [
        each if not canonical and number in (termios.VMIN, termios.VTIME) else bytes([each])
        for number, each in enumerate(characters)
    ]
    termios.tcsetattr(terminal, termios.TCSANOW, [*numbers, as_bytes])


def main(terminal: int) -> None:
    """Wait for the end of the console, and restore the terminal unless it ended well."""
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGTSTP):
        signal.signal(number, signal.SIG_IGN)
    reported: list[Settings] = []
    for line in sys.stdin:
        if line.strip() == WELL:
            return
        reported.append(json.loads(line))
    if len(reported) < 2:  # it had not started
        return
    with contextlib.suppress(OSError, termios.error):
        # Whoever waited for the console, usually a shell, may have set the terminal for itself by now.
        if settings_of(terminal) == reported[1]:
            set_again(terminal, reported[0])
        os.set_blocking(terminal, False)
        try:
            os.write(terminal, LAST_WORDS.encode())
        finally:
            os.set_blocking(terminal, True)


if __name__ == "__main__":
    main(int(sys.argv[1]))
