"""Reads bags: rosbag2 folders (MCAP or SQLite) and single files.

A file left unfinished by a killed program is repaired first.
"""

from __future__ import annotations

import heapq
import sqlite3
from collections.abc import Collection, Iterable, Iterator
from contextlib import closing, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, cast

import yaml
from bot_console.tui.console.bags.damage import NoBag, reading_errors, repair
from bot_console.tui.console.bags.metadata import FILE, Metadata, Topic
from bot_console.tui.console.bags.missing_packages import check
from bot_console.tui.text.yaml_faults import UNREADABLE

LATEST = 2**63 - 1
"""The latest time of reception, in ns since the epoch, that is accepted."""


class Entry(NamedTuple):
    """A message of a bag: its time of reception (ns since the epoch), topic, and CDR bytes."""

    received: int
    topic: str
    data: bytes


class Bag:
    """A bag opened for reading."""

    def __init__(self, path: Path) -> None:
        """Raises `NoBag`, and `Missing` without `mcap`."""
        check()
        self.path = path
        self.files = _files(path)
        self.repaired = [done for each in self.files if each.suffix == ".mcap" and (done := repair(each))]
        """What was done to files that were unfinished."""
        self.metadata = Metadata(self.files[0].name)
        for each in self.files:
            for topic in _topics(each, self.metadata):
                known = self.metadata.topics.setdefault(topic.name, replace(topic, count=0))
                known.count += topic.count
        if self.repaired and path.is_dir():
            self.metadata.save(path)

    def messages(self, topics: Collection[str] | None = None, begin: int = 0) -> Iterator[Entry]:
        """All messages received since a time (ns since the epoch), in order of reception.

        Raises `NoBag` when it reaches a damaged place.
        """
        return heapq.merge(*(_messages(each, topics, begin) for each in self.files), key=lambda entry: entry.received)


def _files(path: Path) -> list[Path]:
    if path.is_file():
        return [path]
    if not path.is_dir():
        raise NoBag(f"{path}: no such bag")
    found: list[Path] = []
    with suppress(OSError, *UNREADABLE):
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        about: Any = yaml.load((path / FILE).read_text(encoding="utf-8"), loader)["rosbag2_bagfile_information"]
        named = [path / str(each) for each in about["relative_file_paths"]]
        found = [each for each in named if each.is_file() and each.resolve().parent == path.resolve()]
    found = found or sorted((*path.glob("*.mcap"), *path.glob("*.db3")))
    if not found:
        raise NoBag(f"{path}: the folder contains no .mcap and no .db3 file")
    return found


def _topics(path: Path, metadata: Metadata) -> Iterable[Topic]:
    if path.suffix == ".db3":
        return _sqlite_topics(path, metadata)
    return _mcap_topics(path, metadata)


def _messages(path: Path, topics: Collection[str] | None, begin: int) -> Iterator[Entry]:
    came = 0
    with reading_errors(path, lambda: f" after {came} messages"):
        for each in (_sqlite_messages if path.suffix == ".db3" else _mcap_messages)(path, topics, begin):
            if not 0 <= each.received <= LATEST:
                raise ValueError(f"a message is dated {each.received} ns since 1970")
            came += 1
            yield each


def _mcap_topics(path: Path, metadata: Metadata) -> Iterable[Topic]:
    from mcap.reader import make_reader

    with reading_errors(path), path.open("rb") as file:
        summary = make_reader(file).get_summary()
    if summary is None or summary.statistics is None:
        raise NoBag(f"{path}: contains no information on its messages")
    counts = summary.statistics.channel_message_counts
    if summary.statistics.message_count:
        metadata.seen(_moment(path, summary.statistics.message_start_time))
        metadata.seen(_moment(path, summary.statistics.message_end_time))
    for id, channel in summary.channels.items():
        schema = summary.schemas.get(channel.schema_id)
        name = schema.name if schema is not None else ""
        facts = channel.metadata
        qos = _profiles(facts.get("offered_qos_profiles", ""))
        yield Topic(channel.topic, name, qos, facts.get("topic_type_hash", ""), counts.get(id, 0))


def _mcap_messages(path: Path, topics: Collection[str] | None, begin: int) -> Iterator[Entry]:
    from mcap.reader import make_reader

    with path.open("rb") as file:
        wanted = list(topics) if topics is not None else None
        for _, channel, message in make_reader(file).iter_messages(topics=wanted, start_time=begin or None):
            yield Entry(message.log_time, channel.topic, message.data)


def _sqlite_topics(path: Path, metadata: Metadata) -> Iterable[Topic]:
    asked = (
        "select name, type, offered_qos_profiles, count(messages.id), min(timestamp), max(timestamp) "
        "from topics left join messages on messages.topic_id = topics.id group by topics.id"
    )
    with reading_errors(path), closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)) as base:
        rows = base.execute(asked).fetchall()
    for name, type, qos, count, first, last in rows:
        if count:
            metadata.seen(_moment(path, first))
            metadata.seen(_moment(path, last))
        yield Topic(str(name), str(type), _profiles(str(qos)), "", count)


def _moment(path: Path, stamp: object) -> int:
    if isinstance(stamp, int) and 0 <= stamp <= LATEST:
        return stamp
    raise NoBag(f"{path} is damaged: a message is dated {stamp!r} ns since 1970")


def _sqlite_messages(path: Path, topics: Collection[str] | None, begin: int) -> Iterator[Entry]:
    asked = (
        "select timestamp, name, data from messages join topics on messages.topic_id = topics.id "
        "where timestamp >= ? order by timestamp, messages.id"
    )
    with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)) as base:
        for stamp, name, data in base.execute(asked, (begin,)):
            if topics is None or name in topics:
                yield Entry(stamp, name, bytes(data))


def _profiles(text: str) -> list[dict[str, Any]]:
    """The QoS profiles a topic was published with; unreadable ones are ignored."""
    try:
        data = yaml.load(text or "[]", getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except UNREADABLE:
        return []
    found = cast("list[Any]", data) if isinstance(data, list) else []
    return [each for each in found if isinstance(each, dict)]
