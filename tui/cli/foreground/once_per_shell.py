"""Prints hints only once per shell."""

from __future__ import annotations

import contextlib
import hashlib
import os
import sys

from bot_console.runtime.programs.exit_messages import stderr_is_terminal
from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, runtime_folder
from bot_console.runtime.rmw.zenoh.domain.sockets import process_exists

FOLDER = "told"
"""The folder of the markers, beside those of the domains."""


def report_once(text: str) -> None:
    """Print a text on stderr; on a terminal, only if it was not printed before in the same session.

    If stderr is not a terminal, as in scripts and logs, the text is printed every time and no marker is saved.
    """
    if not stderr_is_terminal() or _is_new(text):
        print(text, file=sys.stderr)


def _is_new(text: str) -> bool:
    """Mark a text as shown in this shell; returns whether it was not, or True if the marker cannot be saved."""
    try:
        shell = os.getsid(0)
        folder = runtime_folder(FOLDER)
        _forget_ended_shells(folder)
        digest = hashlib.blake2b(text.encode(errors="surrogateescape"), digest_size=8).hexdigest()
        os.close(os.open(os.path.join(folder, f"{shell}.{_start(shell)}.{digest}"), os.O_CREAT | os.O_EXCL, 0o600))
    except FileExistsError:
        return False
    except (OSError, AttributeError, FolderRefusedError):  # AttributeError: Windows has no sessions.
        return True
    return True


def _forget_ended_shells(folder: str) -> None:
    for name in os.listdir(folder):
        shell = name.partition(".")[0]
        if shell.isdecimal() and not process_exists(int(shell)):
            with contextlib.suppress(OSError):
                os.unlink(os.path.join(folder, name))


def _start(pid: int) -> str:
    """The start time of a process, which distinguishes it from an earlier one with the same id; "0" if unknown."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            return file.read().rpartition(b")")[2].split()[19].decode()
    except (OSError, IndexError):
        return "0"
