"""The history of parameter changes, kept between runs in a bounded table of a SQLite file that survives crashes."""

from __future__ import annotations

import contextlib
import json
import sqlite3
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bot_console.tui.console.model import Change, ChangeSource, Value

ROWS = 20_000
"""Rows that are kept; the oldest go."""
TRIMMED_EVERY = 500
"""Rows after which the table is cut to its bound."""
PATIENCE = 0.5
"""Seconds that a write waits for another console that writes to the same file."""
SAME = 2_000_000_000
"""Nanoseconds within which the consoles of one system see the same change."""
BROKEN = ".broken"

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
    AND other.source <> 'elsewhere' AND other.stamp BETWEEN one.stamp - ? AND one.stamp + ?
))
ORDER BY number DESC LIMIT ?
"""


class History:
    """The changes of all runs. A change that `add` has accepted survives the program being killed."""

    def __init__(self, file: Path, run: int, rows: int = ROWS) -> None:
        """`run` is a number unique to this run, such as the time of its start (ns)."""
        self._file = file
        self._run = run
        self._rows = rows
        self._added = 0
        self._waiting: list[tuple[Any, ...]] = []
        self._lock = threading.Lock()
        self._link: sqlite3.Connection | None = None
        self.problem = ""
        """Why changes are not kept, or what was found broken; empty while all is well."""
        self._open()

    def _open(self) -> None:
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            self._link = _opened(self._file)
        except sqlite3.DatabaseError as error:
            if isinstance(error, sqlite3.OperationalError):
                self.problem = f"changes are not kept: {self._file}: {error}"
                return
            self._begin_anew()
        except OSError as error:
            self.problem = f"changes are not kept: {self._file}: {error.strerror}"

    def _begin_anew(self) -> None:
        """Set aside a file that is not a database, so that nothing of it is lost, and start a new one."""
        aside = self._file.with_name(f"{self._file.name}{BROKEN}-{self._run}")
        try:
            self._file.replace(aside)
            for suffix in ("-wal", "-shm"):
                self._file.with_name(self._file.name + suffix).unlink(missing_ok=True)
            self._link = _opened(self._file)
            self.problem = f"the history could not be read and begins anew; it lies in {aside}"
        except (OSError, sqlite3.Error) as error:
            self.problem = f"changes are not kept: {self._file}: {error}"

    def add(self, change: Change) -> None:
        """Store a change; one that cannot be written now is retried with the next."""
        row = (
            *(self._run, change.stamp, change.node, change.name, written(change.old), written(change.new)),
            *(change.source.value, int(change.accepted), change.reason, change.by),
        )
        with self._lock:
            if self._link is None:
                return
            self._waiting = [*self._waiting, row][-self._rows :]
            try:
                with self._link:
                    self._link.executemany(_INSERT, self._waiting)
                    self._added += len(self._waiting)
                    if self._added >= TRIMMED_EVERY:
                        self._trim(self._link)
                self._waiting.clear()
                self.problem = ""
            except sqlite3.Error as error:
                self.problem = f"changes are not kept: {self._file}: {error}"

    def _trim(self, link: sqlite3.Connection) -> None:
        self._added = 0
        link.execute("DELETE FROM changes WHERE number <= (SELECT MAX(number) FROM changes) - ?", (self._rows,))

    def earlier(self, most: int) -> Sequence[Change]:
        """The newest changes of other runs, oldest first, numbered up to -1.

        If two consoles saw the same change, the row of the one that made it stands for both.
        """
        with self._lock:
            if self._link is None:
                return ()
            try:
                found = self._link.execute(_EARLIER, (self._run, SAME, SAME, most)).fetchall()
            except sqlite3.Error as error:
                self.problem = f"the history cannot be read: {self._file}: {error}"
                return ()
        return [_change(-1 - at, row) for at, row in enumerate(found)][::-1]

    def close(self) -> None:
        """Close the file; a second call does nothing."""
        with self._lock:
            link, self._link = self._link, None
            if link is not None:
                with contextlib.suppress(sqlite3.Error):
                    link.close()


def _opened(file: Path) -> sqlite3.Connection:
    """A connection whose commits survive the program being killed."""
    link = sqlite3.connect(file, timeout=PATIENCE, check_same_thread=False)
    try:
        # A write-ahead log is whole after a crash, and other consoles can read while one writes.
        link.execute("PRAGMA journal_mode = WAL")
        link.execute("PRAGMA synchronous = NORMAL")
        with link:
            link.execute(_TABLE)
            link.execute("CREATE INDEX IF NOT EXISTS of_parameter ON changes (node, name, stamp)")
    except BaseException:
        link.close()
        raise
    return link


def _change(seq: int, row: tuple[Any, ...]) -> Change:
    stamp, node, name, old, new, source, accepted, reason, by, run = row
    return Change(seq, stamp, node, name, read(old), read(new), _source(source), bool(accepted), reason, by, run)


def _source(word: str) -> ChangeSource:
    try:
        return ChangeSource(word)
    except ValueError:  # written by a newer version
        return ChangeSource.OTHER


def written(value: Value) -> str:
    """A value as text, from which `read` makes exactly that value again."""
    if isinstance(value, tuple):
        return json.dumps([{"byte": each[0]} if isinstance(each, bytes) else each for each in value])
    return json.dumps(value)


def read(text: str) -> Value:
    """The value of such a text."""
    value: Any = json.loads(text)
    if isinstance(value, list):
        return tuple(bytes([each["byte"]]) if isinstance(each, dict) else each for each in value)  # type: ignore[misc] -- JSON as it was written here
    return value
