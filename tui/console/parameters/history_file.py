"""Keeps the history of parameter changes between runs, in a bounded table of a SQLite file that survives crashes."""

from __future__ import annotations

import contextlib
import json
import sqlite3
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

from bot_console.tui.console.model import Change, ChangeSource, Value
from bot_console.tui.files.folder_lock import folder_lock
from bot_console.tui.text.encodable import encodable

MAX_ROWS = 20_000
"""The number of rows kept; the oldest are deleted."""
ROWS_PER_TRIM = 500
"""Number of insertions after which the table is trimmed."""
TIMEOUT_S = 0.5
"""Seconds that a console waits for another one that is writing to the same file."""
SAME_CHANGE_NS = 2_000_000_000
"""Equal changes that two consoles recorded within this time (ns) count as one."""
BROKEN = ".broken"
NOT_ANSWERED = -1
"""A third value of the column `accepted`, besides accepted (1) and refused (0)."""
UNSTORABLE = (
    ValueError,
    OverflowError,
    TypeError,
    sqlite3.InterfaceError,
    sqlite3.ProgrammingError,
    sqlite3.IntegrityError,
)
"""The exceptions that SQLite raises for a row that it can never store."""

_TABLE = """
CREATE TABLE IF NOT EXISTS changes (
    number INTEGER PRIMARY KEY, run INTEGER NOT NULL, stamp INTEGER NOT NULL, node TEXT NOT NULL, name TEXT NOT NULL,
    old TEXT NOT NULL, new TEXT NOT NULL, source TEXT NOT NULL, accepted INTEGER NOT NULL, reason TEXT NOT NULL,
    part_of TEXT NOT NULL
)
"""
_INSERT = """
INSERT INTO changes (run, stamp, node, name, old, new, source, accepted, reason, part_of)
VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)
"""
_EARLIER = """
SELECT stamp, node, name, old, new, source, accepted, reason, part_of, run FROM changes AS one
WHERE run <> ? AND NOT (source = 'elsewhere' AND EXISTS (
    SELECT 1 FROM changes AS other WHERE other.node = one.node AND other.name = one.name AND other.new = one.new
    AND (other.source <> 'elsewhere' OR other.run < one.run) AND other.stamp BETWEEN one.stamp - ? AND one.stamp + ?
))
ORDER BY number DESC LIMIT ?
"""


class History:
    """The changes of all runs. A change that `add` has accepted survives if the program is killed."""

    def __init__(self, file: Path, run: int, rows: int = MAX_ROWS) -> None:
        """`run` is a number unique to this run, such as the time of its start (ns)."""
        self._file = file
        self._run = run
        self._rows = rows
        self._added = 0
        self._waiting: list[tuple[Any, ...]] = []
        self._lock = threading.Lock()
        self._link: sqlite3.Connection | None = None
        self.problem = ""
        """Why changes are not kept, or what is damaged; empty while all is well."""
        self._open()

    def _open(self) -> None:
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            if self._file.exists() and not self._file.is_file():
                self.problem = f"changes are not kept: {self._file} is not a regular file"
                return
            self._link = _open_database(self._file)
        except sqlite3.DatabaseError as error:
            if isinstance(error, sqlite3.OperationalError):
                self.problem = f"changes are not kept: {self._file}: {error}"
                return
            self._restart()
        except OSError as error:
            self.problem = f"changes are not kept: {self._file}: {error.strerror}"

    def _restart(self) -> None:
        """Move aside a file that is not a database, so that nothing in it is lost, and start a new one.

        If several consoles find the same file, one of them does this and the others use the new file.
        """
        try:
            with folder_lock(self._file.parent, TIMEOUT_S) as locked:
                self.problem = (
                    self._replace_file() if locked else "changes are not kept: another console is repairing the file"
                )
        except (OSError, sqlite3.Error) as error:
            self.problem = f"changes are not kept: {self._file}: {error}"

    def _replace_file(self) -> str:
        """Replace the file with a new database unless another console has done so; returns a message for the user."""
        try:
            self._link = _open_database(self._file)
        except sqlite3.OperationalError:
            raise
        except sqlite3.DatabaseError:
            aside = self._file.with_name(f"{self._file.name}{BROKEN}-{self._run}")
            self._file.replace(aside)
            for suffix in ("-wal", "-shm"):
                self._file.with_name(self._file.name + suffix).unlink(missing_ok=True)
            self._link = _open_database(self._file)
            return f"the history could not be read and starts afresh; the old file is {aside}"
        return ""

    def add(self, change: Change) -> None:
        """Store a change; a change that cannot be written now is retried with the next one."""
        row = (
            *(self._run, change.stamp, encodable(change.node), encodable(change.name)),
            *(written(change.old), written(change.new)),
            *(change.source.value, _outcome(change), encodable(change.reason), encodable(change.by)),
        )
        with self._lock:
            if self._link is None:
                return
            self._waiting = [*self._waiting, row][-self._rows :]
            try:
                with self._link:
                    lost = [each for each in self._waiting if not _insert(self._link, each)]
                    self._added += len(self._waiting)
                    if self._added >= ROWS_PER_TRIM:
                        self._trim(self._link)
                self._waiting.clear()
                self.problem = f"{len(lost)} changes cannot be kept: {self._file}" if lost else ""
            except sqlite3.Error as error:
                self.problem = f"changes are not kept: {self._file}: {error}"

    def _trim(self, link: sqlite3.Connection) -> None:
        self._added = 0
        link.execute("DELETE FROM changes WHERE number <= (SELECT MAX(number) FROM changes) - ?", (self._rows,))

    def earlier(self, maximum: int) -> Sequence[Change]:
        """The newest changes of other runs, oldest first and numbered up to -1; unreadable rows are left out.

        If several consoles recorded the same change, only the row of the console that made it is returned; if another
        program made it, that of the console that started first.
        """
        found: list[Change] = []
        unreadable, ended = 0, ""
        with self._lock:
            if self._link is None:
                return ()
            try:
                for row in self._link.execute(_EARLIER, (self._run, SAME_CHANGE_NS, SAME_CHANGE_NS, maximum)):
                    change = _change(-1 - len(found), row)
                    if change is None:
                        unreadable += 1
                    else:
                        found.append(change)
            except sqlite3.Error as error:  # the file is damaged here; the rows before are valid
                ended = str(error)
        if ended:
            self.problem = f"the history cannot be read: {self._file}: {ended}"
        elif unreadable:
            rows = f"{unreadable} row{'s' * (unreadable > 1)} of the history cannot be read"
            self.problem = f"{rows} and {'are' if unreadable > 1 else 'is'} left out: {self._file}"
        return found[::-1]

    def close(self) -> None:
        """Close the file; a second call does nothing."""
        with self._lock:
            link, self._link = self._link, None
            if link is not None:
                with contextlib.suppress(sqlite3.Error):
                    link.close()


def _open_database(file: Path) -> sqlite3.Connection:
    """Open a connection whose commits survive if the program is killed."""
    link = sqlite3.connect(file, timeout=TIMEOUT_S, check_same_thread=False)
    try:
        # A write-ahead log stays consistent after a crash, and lets other consoles read while one is writing.
        link.execute("PRAGMA journal_mode = WAL")
        link.execute("PRAGMA synchronous = NORMAL")
        link.text_factory = _text  # so that a byte that is not UTF-8 makes one row unreadable, not all of them
        with link:
            link.execute(_TABLE)
            link.execute("CREATE INDEX IF NOT EXISTS of_parameter ON changes (node, name, stamp)")
    except BaseException:
        link.close()
        raise
    return link


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")


def _insert(link: sqlite3.Connection, row: tuple[Any, ...]) -> bool:
    """Insert a row; returns False if it can never be stored, which must not keep other rows from being stored."""
    try:
        link.execute(_INSERT, row)
    except UNSTORABLE:
        return False
    return True


def _change(seq: int, row: tuple[Any, ...]) -> Change | None:
    """The change in a row; None if the row is not in the format that `add` writes."""
    stamp, node, name, old, new, source, accepted, reason, by, run = row
    if not all(isinstance(each, str) for each in (node, name, old, new, source, reason, by)):
        return None
    if not all(isinstance(each, int) for each in (stamp, accepted, run)):
        return None
    try:
        of = stamp, node, name, read(old), read(new), _source(source)
        return Change(seq, *of, accepted > 0, reason, by, run, accepted != NOT_ANSWERED)
    except (ValueError, TypeError, LookupError, RecursionError):
        return None


def _outcome(change: Change) -> int:
    return int(change.accepted) if change.answered else NOT_ANSWERED


def _source(word: str) -> ChangeSource:
    try:
        return ChangeSource(word)
    except ValueError:  # written by a newer version
        return ChangeSource.OTHER


def written(value: Value) -> str:
    """Write a value as text, from which `read` restores exactly this value."""
    if isinstance(value, tuple):
        return json.dumps([{"byte": each[0]} if isinstance(each, bytes) else each for each in value])
    return json.dumps(value)


def read(text: str) -> Value:
    """Parse the text of a value; raises `ValueError`, `TypeError`, `LookupError` or `RecursionError` if it is none."""
    value: Any = json.loads(text)
    if isinstance(value, list):
        return tuple(_element(each) for each in cast("list[Any]", value))
    if value is not None and not isinstance(value, (bool, int, float, str)):
        raise ValueError(f"{text[:40]} is not the value of a parameter")
    return encodable(value) if isinstance(value, str) else value


def _element(value: Any) -> bool | int | float | str | bytes:
    if isinstance(value, dict):
        return bytes([cast("dict[str, Any]", value)["byte"]])
    if not isinstance(value, (bool, int, float, str)):
        raise ValueError(f"{value!r} is not a valid element of a parameter")
    return encodable(value) if isinstance(value, str) else value
