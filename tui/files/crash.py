"""Records a crash of the console itself: one line for the person, the full traceback in a file."""

from __future__ import annotations

import contextlib
import os
import platform
import tempfile
import time
import traceback
from pathlib import Path

from bot_console.tui.files.folders import state_folder


def reason(error: BaseException) -> str:
    """The exception on one line, with the place where it was raised."""
    last = traceback.extract_tb(error.__traceback__)[-1:]
    where = f" ({Path(last[0].filename).name}:{last[0].lineno})" if last else ""
    text = " ".join(str(error).split())
    return f"{type(error).__name__}{': ' + text if text else ''}{where}"


def save_traceback(error: BaseException) -> str:
    """Write the traceback to a file and return its path; empty if nothing can be written."""
    text = "".join(traceback.format_exception(type(error), error, error.__traceback__))
    name = f"crash-{time.strftime('%Y%m%d-%H%M%S')}-{os.getpid()}.txt"
    for folder in (state_folder(), Path(tempfile.gettempdir())):
        with contextlib.suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            file = folder / name
            with file.open("a", encoding="utf-8", errors="backslashreplace") as kept:
                kept.write(f"Python {platform.python_version()}, {platform.platform()}\n{text}\n")
            return str(file)
    return ""
