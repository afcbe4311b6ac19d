"""The command lines of a domain's terminals, recorded while a lesson is open in that domain.

The lesson creates the file, and each `bot-console` or `ros2` command appends a line when it starts and another when it
ends; without the file, nothing is recorded. The file is in the domain's folder, which no other user can read.

Every command imports this module, so it imports little itself.
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
"""Maximum recorded words of a command line, and characters of a word."""
SETTLING_S = 3.0
"""Seconds that one of the `LONG_RUNNING` commands has to run before it counts as working: it may still fail."""
LONG_RUNNING = frozenset(("run", "launch", "topic", "bag"))
"""Commands that run until somebody ends them; other commands count as having worked when they have ended."""
MAX_ERROR_CHARACTERS = 500
"""Maximum characters of the end of a command's stderr that are recorded."""
MAX_BYTES = 4_000_000
"""The size of the file at which recording stops."""
ENDED_BY_SIGNAL = (128 + signal.SIGINT, 128 + signal.SIGTERM)
"""Exit codes of commands after Ctrl-C and SIGTERM."""
UNRECORDED = frozenset(("--version", "complete", "learn", "release", "stop"))
"""Commands that are not recorded: no step asks for them, or nothing may delay them."""


class Command(NamedTuple):
    """A command line, its exit code (None while it runs), and whether it has run for `SETTLING_S`."""

    words: tuple[str, ...]
    code: int | None = None
    settled: bool = True
    errors: str = ""
    """The end of its error output, for commands whose exit code does not say whether they have succeeded."""

    @property
    def is_working(self) -> bool:
        """Whether it has succeeded, or has been running long enough to count as working."""
        return not self.failed if self.code is not None else self.settled and not LONG_RUNNING.isdisjoint(self.verb[:1])

    @property
    def failed(self) -> bool:
        """Whether it ended with an error; the end by Ctrl-C or SIGTERM is not one."""
        return self.code not in (None, 0, *ENDED_BY_SIGNAL)

    @property
    def verb(self) -> tuple[str, ...]:
        """Its words from the verb on, without a leading `ros2`."""
        return self.words[1:] if self.words[:1] == ("ros2",) else self.words


def open_log() -> str:
    """Start recording the commands of this domain in a new file; returns its path, raises `FolderRefusedError`."""
    path = os.path.join(domain_folder(domain_id()), NAME)
    with open(path, "w", encoding="utf-8"):
        os.chmod(path, 0o600)
    return path


def log_path(words: Sequence[str]) -> str:
    """Return the path of the file to record a command in; empty if no lesson is open. Costs one file system call."""
    if not words or words[0] in UNRECORDED:
        return ""
    try:
        path = os.path.join(base_folder(), str(domain_id()), NAME)
    except ValueError:
        return ""
    return path if os.path.exists(path) else ""


class ErrorTail:
    """Replaces stderr, and keeps the end of what is written to it."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self.text = ""

    def write(self, text: str) -> int:
        """Write a text to the real stream."""
        self.text = (self.text + text)[-MAX_ERROR_CHARACTERS:]
        return self._stream.write(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def record_command(words: Sequence[str]) -> Generator[Callable[[int], int]]:
    """Record a command line if a lesson is open; yields a function that takes the exit code and returns it.

    An interrupted command is recorded with the exit code that shells use for Ctrl-C, since `ros2` exits with the same
    code as after wrong usage. As in ROS 2, `param set` exits with 0 when the node has refused the value, so its error
    output is recorded as well.
    """
    path = log_path(words)
    if not path:
        yield lambda code: code
        return
    codes: list[int] = []
    tail, stderr = ErrorTail(sys.stderr), sys.stderr
    append_record(path, words, None)
    if Command(tuple(words)).verb[:1] == ("param",):
        sys.stderr = cast("TextIO", tail)

    def end(code: int) -> int:
        codes.append(128 + signal.SIGINT if isinstance(code, Interrupted) else code)
        return code

    try:
        yield end
    finally:
        sys.stderr = stderr
        append_record(path, words, codes[0] if codes else 1, tail.text)


def append_record(path: str, words: Sequence[str], code: int | None, errors: str = "") -> None:
    """Append a command; errors are ignored, since a command must not fail because it cannot be recorded."""
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

    Unreadable lines are skipped.
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
            found[number] = command  # another process with the same id, or the same command started again
        else:
            found[pid, words] = command
    return list(found.values())
