"""Writes the log of a background system, with every line of its processes, to rotating files."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from pathlib import Path

from bot_console.tui.files.folders import state_folder
from bot_console.tui.session.embedded.rotating_file import STANDARD_STREAMS, RotatingFile

MAX_FILE_BYTES = 5_000_000
"""The size at which a file is rotated, in bytes."""
MAX_OLD_FILES = 4
"""The number of older files kept per system, named `.1` (the newest) and up."""
MAX_SYSTEMS = 5
"""The number of systems whose logs are kept."""
NAMES = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}


class SystemLog:
    """Writes lines as `[INFO] [1700000000.123456] [talker]: text`; thread-safe."""

    def __init__(self, path: Path, max_bytes: int = MAX_FILE_BYTES) -> None:
        self._handler = RotatingFile(path, max_bytes, MAX_OLD_FILES, STANDARD_STREAMS)

    def logged(self, stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
        """Write a logger's line; `stamp` is in ns since the epoch."""
        line = f"[{NAMES.get(severity, 'INFO')}] [{stamp * 1e-9:.6f}] [{name}]: {text}"
        self._handler.handle(logging.LogRecord(name, severity, site[0], site[2], line, None, None))

    def printed(self, severity: int, name: str, text: str) -> None:
        """Write a line that a process has just printed."""
        self.logged(time.time_ns(), severity, name, text, ("", "", 0))

    def close(self) -> None:
        """Close the file."""
        self._handler.close()


def new_log(pid: int) -> Path:
    """The path of the log of a system that starts now; deletes the logs of all but the newest systems."""
    folder = state_folder() / "systems"
    folder.mkdir(parents=True, exist_ok=True)
    old = sorted(folder.glob("*.log"), key=lambda each: each.stat().st_mtime)
    for first in old[: max(0, len(old) - MAX_SYSTEMS + 1)]:
        for each in (first, *parts(first)):
            each.unlink(missing_ok=True)
    return folder / f"{time.strftime('%Y%m%d-%H%M%S')}-{pid}.log"


def parts(log: Path) -> Iterator[Path]:
    """The older, rotated files of a log."""
    return log.parent.glob(f"{log.name}.*")
