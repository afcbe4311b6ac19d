"""The command lines of a domain's terminals, written down while a lesson is open in that domain.

The lesson makes the file, and each `bot-console` or `ros2` command appends a line to it when it starts and when it
ends; without the file nothing is written. It is in the domain's own folder, which no other user can read.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.domain_id import domain_id
from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, domain_folder
from bot_console.tui.learn.deeds import Command
from bot_console.tui.learn.open_lesson import NAME

MAX_WORDS, MAX_CHARACTERS = 40, 200
"""Of a command line, what is kept."""
MAX_BYTES = 4_000_000
"""The size from which nothing more is written."""


def open_log() -> Path:
    """Begin to write down the commands of this domain, anew; raises `FolderRefusedError`."""
    path = Path(domain_folder(domain_id())) / NAME
    path.write_text("", encoding="utf-8")
    path.chmod(0o600)
    return path


def append(path: str, words: Sequence[str], code: int | None) -> None:
    """Write a command down; what cannot be written is left out, since a command must not fail for it."""
    kept = [each[:MAX_CHARACTERS].encode("utf-8", "replace").decode() for each in words[:MAX_WORDS]]
    line = json.dumps({"pid": os.getpid(), "words": kept, "code": code}) + "\n"
    with contextlib.suppress(OSError):
        if os.path.getsize(path) < MAX_BYTES:
            with open(path, "a", encoding="utf-8") as file:
                file.write(line)


def read_log(path: Path) -> list[Command]:
    """The commands so far, in the order in which they started; lines that cannot be read are left out."""
    found: dict[object, Command] = {}
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []
    for number, line in enumerate(lines):
        try:
            row = json.loads(line)
            words, code = tuple(str(each) for each in row["words"]), row["code"]
        except (ValueError, TypeError, KeyError):
            continue
        key = (row.get("pid"), words)
        if key in found and found[key].code is None and isinstance(code, int):
            found[key] = Command(words, code)
        else:
            found[(number, words) if key in found else key] = Command(words, code if isinstance(code, int) else None)
    return list(found.values())


__all__ = ["FolderRefusedError", "append", "open_log", "read_log"]
