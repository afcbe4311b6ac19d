"""Executables as scripts, as `colcon build` installs them, for prefixes such as `python3 -m pdb`."""

from __future__ import annotations

import hashlib
import os
import sys
from pathlib import Path

from bot_console.runtime.files.user_folders import cache_folder
from bot_console.runtime.process.scratch import scratch
from bot_console.runtime.workspace.executables import Executable

ENTRY_POINT = """\
#!{interpreter}
import sys
from {module} import {first}

if __name__ == "__main__":
    sys.exit({function}())
"""
FILE = """\
#!{interpreter}
import os, runpy, sys

if __name__ == "__main__":
    sys.argv[0] = {path!r}
    sys.path[0] = os.path.dirname(sys.argv[0])
    runpy.run_path(sys.argv[0], run_name="__main__")
"""


def script_of(executable: Executable) -> Path:
    """Return the script of an entry point, or the file itself; raises `OSError` if no script can be written."""
    entry = executable.entry_point
    if entry is None:
        return executable.path or Path(executable.name)
    first = entry.function.partition(".")[0]
    text = ENTRY_POINT.format(interpreter=sys.executable, module=entry.module, first=first, function=entry.function)
    return _write_script(os.path.join(executable.package, executable.name), text)


def script_of_file(path: str) -> Path:
    """Return a script that runs a Python file with this interpreter, whatever the file's first line and permissions
    are.

    Raises `OSError` if it cannot be written.
    """
    path = os.path.abspath(path)
    return _write_script(os.path.basename(path), FILE.format(interpreter=sys.executable, path=path))


def _write_script(name: str, text: str) -> Path:
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    try:
        return _write(cache_folder() / "scripts" / digest / name, text)
    except OSError:  # the user's cache is not writable
        return _write(Path(scratch()) / f"bot-console-scripts-{os.getuid()}" / digest / name, text)


def _write(path: Path, text: str) -> Path:
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        beside = path.with_name(f".{path.name}.{os.getpid()}")
        beside.write_text(text, encoding="utf-8")
        beside.chmod(0o755)
        beside.replace(path)
    return path
