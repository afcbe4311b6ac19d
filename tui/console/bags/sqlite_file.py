"""Reads an SQLite bag file written by any version of rosbag2."""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Iterator
from contextlib import closing
from pathlib import Path

from bot_console.tui.console.bags.metadata import Topic, qos_profiles

OPTIONAL = ("serialization_format", "offered_qos_profiles", "type_description_hash")
"""Columns of the table of topics that files of early versions lack."""


class SqliteFile:
    """The contents of a bag file. Raises `sqlite3.Error` and `ValueError` if it is damaged."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.begin, self.end = 0, 0
        """Times of the first and last message (ns since the epoch); 0 if there is none."""
        self._topics: list[Topic] = []
        with closing(self._open()) as base:
            known = {row[1] for row in base.execute("pragma table_info(topics)")}
            optional = ", ".join(each if each in known else "''" for each in OPTIONAL)
            asked = (
                f"select name, type, {optional}, count(messages.id), min(timestamp), max(timestamp) "
                "from topics left join messages on messages.topic_id = topics.id group by topics.id"
            )
            rows = base.execute(asked).fetchall()
        times: list[int] = []
        for name, type, encoding, qos, type_hash, count, first, last in rows:
            times += [_check_stamp(first), _check_stamp(last)] if count else []
            profiles = qos_profiles(str(qos))
            self._topics.append(Topic(str(name), str(type), profiles, str(type_hash), count, str(encoding) or "cdr"))
        if times:
            self.begin, self.end = min(times), max(times)

    def topics(self) -> Iterator[Topic]:
        """The recorded topics."""
        yield from self._topics

    def messages(self, topics: Collection[str] | None, begin: int) -> Iterator[tuple[int, str, bytes]]:
        """The messages received since a time, in order: (time of reception in ns, topic, data)."""
        asked = (
            "select timestamp, name, data from messages join topics on messages.topic_id = topics.id "
            "where timestamp >= ? order by timestamp, messages.id"
        )
        with closing(self._open()) as base:
            for stamp, name, data in base.execute(asked, (begin,)):
                if topics is None or name in topics:
                    if not isinstance(data, bytes):
                        raise ValueError(f"a message of {name} is not binary data")
                    yield stamp, name, data

    def _open(self) -> sqlite3.Connection:
        """Open the file read-only, even in a folder without write access."""
        uri = self._path.resolve().as_uri()
        base = sqlite3.connect(f"{uri}?mode=ro", uri=True)
        try:
            base.execute("select count(*) from sqlite_master")
        except sqlite3.OperationalError:  # beside a journal, SQLite writes even when it only reads
            base.close()
            base = sqlite3.connect(f"{uri}?mode=ro&immutable=1", uri=True)
        return base


def _check_stamp(stamp: object) -> int:
    if isinstance(stamp, int):
        return stamp
    raise ValueError(f"a message is dated {stamp!r} ns since 1970")
