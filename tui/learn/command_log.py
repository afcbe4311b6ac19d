"""The command lines of a domain's terminals, recorded while a lesson is open in that domain.

The lesson makes the file, and each `bot-console` or `ros2` command appends a line to it when it starts and when it
ends; without the file nothing is recorded. It is in the domain's own folder, which no other user can read.

Every command imports this module, so its own imports are few.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple, TextIO, cast

from bot_console.runtime.domain_id import domain_id
from bot_console.runtime.programs.exit_messages import Interrupted
from bot_console.runtime.rmw.zenoh.domain.folder import base_folder, domain_folder

NAME = "commands.jsonl"
MAX_WORDS, MAX_WORD_CHARACTERS = 40, 200
"""Of a command line, what is recorded."""
SETTLING_S = 3.0
"""Seconds for which one of `LASTING` has to run before it counts as one that works: until then it may still fail."""
LASTING = frozenset(("run", "launch", "topic", "bag"))
"""Commands that last until somebody ends them; others have worked when they have ended."""
MAX_ERROR_CHARACTERS = 500
"""Of the end of what a command writes to stderr."""
MAX_BYTES = 4_000_000
"""The size from which nothing more is recorded."""
ENDED_BY_SIGNAL = (128 + signal.SIGINT, 128 + signal.SIGTERM)
"""Exit codes of commands after Ctrl-C and SIGTERM."""
UNRECORDED = frozenset(("--version", "complete", "learn", "release", "stop"))
"""Commands that no step asks for, or that nothing may delay."""


class Command(NamedTuple):
    """A command line, its exit code (None while it runs), and whether it has run for `SETTLING_S`."""

    words: tuple[str, ...]
    code: int | None = None
    settled: bool = True
    errors: str = ""
    """The end of its error output, for commands whose exit code does not say whether they had success."""

    @property
    def works(self) -> bool:
        """Whether it has done what it was asked for, or is doing it."""
        return not self.failed if self.code is not None else self.settled and not LASTING.isdisjoint(self.verb[:1])

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


class ErrorTail:
    """Stands for stderr, and keeps the end of what is written to it."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self.text = ""

    def write(self, text: str) -> int:
        """Write a text."""
        self.text = (self.text + text)[-MAX_ERROR_CHARACTERS:]
        return self._stream.write(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def recorded(words: Sequence[str]) -> Generator[Callable[[int], int]]:
    """Record a command line if a lesson is open; what is yielded takes the exit code and returns it.

    An interrupted command is recorded with the code that shells use for Ctrl-C: that of `ros2` is also that of a wrong
    command line. As in ROS 2, `param set` ends with 0 when the node has refused: only its error output tells.
    """
    path = log_for(words)
    if not path:
        yield lambda code: code
        return
    codes: list[int] = []
    tail, stderr = ErrorTail(sys.stderr), sys.stderr
    record(path, words, None)
    if Command(tuple(words)).verb[:1] == ("param",):
        sys.stderr = cast("TextIO", tail)

    def end(code: int) -> int:
        codes.append(128 + signal.SIGINT if isinstance(code, Interrupted) else code)
        return code

    try:
        yield end
    finally:
        sys.stderr = stderr
        record(path, words, codes[0] if codes else 1, tail.text)


def record(path: str, words: Sequence[str], code: int | None, errors: str = "") -> None:
    """Append a command; one that cannot be recorded is left out, since it must not fail for that."""
    import json

    kept = [each[:MAX_WORD_CHARACTERS].encode("utf-8", "replace").decode() for each in words[:MAX_WORDS]]
    row = {"pid": os.getpid(), "at": time.time(), "words": kept, "code": code, "errors": errors[-MAX_ERROR_CHARACTERS:]}
    line = json.dumps(row) + "\n"
    try:
        if os.path.getsize(path) < MAX_BYTES:
            with open(path, "a", encoding="utf-8") as file:
                file.write(line)
    except OSError:
        pass


def read_log(path: str, now: float = float("inf")) -> list[Command]:
    """Return the commands until `now` (s since 1970), in the order in which they started.

    Lines that cannot be read are left out.
    """
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
            words, code, pid = tuple(str(each) for each in row["words"]), row["code"], int(row["pid"])
            settled, errors = now - float(row["at"]) >= SETTLING_S, str(row["errors"])
        except (ValueError, TypeError, KeyError, OverflowError, RecursionError):
            continue
        command = Command(words, code if isinstance(code, int) else None, settled, errors)
        started = found.get((pid, words))
        if started is not None and (started.code is not None or command.code is None):
            found[number] = command  # another process with the same id, or another start of the same words
        else:
            found[pid, words] = command
    return list(found.values())
