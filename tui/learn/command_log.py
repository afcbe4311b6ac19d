"""The command lines of a domain's terminals, recorded while a lesson is open in that domain.

The lesson makes the file, and each `bot-console` or `ros2` command appends a line to it when it starts and when it
ends; without the file nothing is recorded. It is in the domain's own folder, which no other user can read.

Every command imports this module, so its own imports are few.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from typing import NamedTuple

from bot_console.runtime.domain_id import domain_id
from bot_console.runtime.rmw.zenoh.domain.folder import base_folder, domain_folder

NAME = "commands.jsonl"
MAX_WORDS, MAX_WORD_CHARACTERS = 40, 200
"""Of a command line, what is recorded."""
MAX_BYTES = 4_000_000
"""The size from which nothing more is recorded."""
ENDED_BY_SIGNAL = (128 + signal.SIGINT, 128 + signal.SIGTERM)
"""Exit codes of commands after Ctrl-C and SIGTERM."""
UNRECORDED = frozenset(("--version", "complete", "learn", "release", "stop"))
"""Commands that no step asks for, or that nothing may delay."""


class Command(NamedTuple):
    """A command line and its exit code; None while it runs."""

    words: tuple[str, ...]
    code: int | None = None

    @property
    def failed(self) -> bool:
        """Whether it ended with an error. Ctrl-C and SIGTERM end a program that works."""
        return self.code not in (None, 0, *ENDED_BY_SIGNAL)

    @property
    def verb(self) -> tuple[str, ...]:
        """Its words from the verb on: a leading `ros2` changes nothing."""
        return self.words[1:] if self.words[:1] == ("ros2",) else self.words


def open_log() -> str:
    """Begin to record the commands of this domain, in a new file; raises `FolderRefusedError`."""
    path = os.path.join(domain_folder(domain_id()), NAME)
    with open(path, "w", encoding="utf-8"):
        os.chmod(path, 0o600)
    return path


def log_for(words: Sequence[str]) -> str:
    """Return the file in which a command is to be recorded; empty if no lesson is open. Costs one file system call."""
    if not words or words[0] in UNRECORDED:
        return ""
    try:
        path = os.path.join(base_folder(), str(domain_id()), NAME)
    except ValueError:
        return ""
    return path if os.path.exists(path) else ""


def record(path: str, words: Sequence[str], code: int | None) -> None:
    """Append a command; one that cannot be recorded is left out, since it must not fail for that."""
    import json

    kept = [each[:MAX_WORD_CHARACTERS].encode("utf-8", "replace").decode() for each in words[:MAX_WORDS]]
    line = json.dumps({"pid": os.getpid(), "words": kept, "code": code}) + "\n"
    try:
        if os.path.getsize(path) < MAX_BYTES:
            with open(path, "a", encoding="utf-8") as file:
                file.write(line)
    except OSError:
        pass


def read_log(path: str) -> list[Command]:
    """Return the commands so far, in the order in which they started; lines that cannot be read are left out."""
    import json

    found: dict[object, Command] = {}
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            lines = file.read().splitlines()
    except OSError:
        return []
    for number, line in enumerate(lines):
        try:
            row = json.loads(line)
            words, code, pid = tuple(str(each) for each in row["words"]), row["code"], row["pid"]
        except (ValueError, TypeError, KeyError):
            continue
        command = Command(words, code if isinstance(code, int) else None)
        started = found.get((pid, words))
        if started is not None and (started.code is not None or command.code is None):
            found[number] = command  # another process with the same id, or another start of the same words
        else:
            found[pid, words] = command
    return list(found.values())
