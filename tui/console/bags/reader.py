"""Reads bags: rosbag2 folders and single files (MCAP or SQLite), compressed or not.

A file left unfinished by a killed program is repaired first.
"""

from __future__ import annotations

import heapq
import shutil
import tempfile
import weakref
from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import yaml
from bot_console.tui.console.bags.compression import ZSTD, unpack_file, unpack_message
from bot_console.tui.console.bags.damage import BagError, reading_errors, repair
from bot_console.tui.console.bags.metadata import FILE, FilePart, Metadata, Topic
from bot_console.tui.console.bags.missing_packages import check
from bot_console.tui.console.bags.sqlite_file import SqliteFile
from bot_console.tui.text.yaml_faults import UNREADABLE

if TYPE_CHECKING:
    from bot_console.tui.console.bags.mcap_file import McapFile

LATEST_NS = 2**63 - 1
"""The latest time of reception that is accepted, in ns since the epoch."""
PATTERNS = ("*.mcap", "*.db3", "*.mcap.zstd", "*.db3.zstd")
ROS1, SQLITE = b"#ROSBAG", b"SQLite format 3\0"
"""The first bytes of these files."""


class Entry(NamedTuple):
    """A message of a bag: its time of reception (ns since the epoch), topic, and CDR bytes."""

    received: int
    topic: str
    data: bytes


class Bag:
    """A bag opened for reading."""

    def __init__(self, path: Path, *, listed: bool = True) -> None:
        """Open the files that the metadata lists or, without `listed`, all bag files in the folder.

        Raises `BagError`, and `MissingPackageError` without `mcap`.
        """
        check()
        self.path = path
        about = _read_metadata(path)
        self.files = _files(path, about if listed else {})
        self.repaired: list[str] = []
        """The repairs made to files that were unfinished."""
        self._unpacked: Path | None = None
        self._opened = [(each, self._open(each, self._unpacked_path(each))) for each in self.files]
        self.metadata = Metadata([], storage=self.storage, compression=_compression(about), custom=_custom(about))
        for file, contents in self._opened:
            self._add_to_metadata(file, contents)
        if self.repaired and path.is_dir() and self._unpacked is None:
            self.metadata.save(path)

    def messages(self, topics: Collection[str] | None = None, begin: int = 0) -> Iterator[Entry]:
        """All messages received since a time (ns since the epoch), in order of reception.

        Raises `BagError` on reaching damaged data.
        """
        found = (_messages(file, contents, topics, begin) for file, contents in self._opened)
        return heapq.merge(*found, key=lambda entry: entry.received)

    @property
    def topics(self) -> Mapping[str, Topic]:
        """The recorded topics, by name."""
        return self.metadata.topics

    @property
    def span(self) -> tuple[int, int]:
        """Times of the first and the last message (ns since the epoch); 0 if there is none."""
        return self.metadata.begin, self.metadata.end

    @property
    def storage(self) -> str:
        """The name of the ROS 2 storage plug-in for these files."""
        return "sqlite3" if isinstance(self._opened[0][1], SqliteFile) else "mcap"

    def _unpacked_path(self, path: Path) -> Path:
        """The file itself or, if it is compressed as a whole, its unpacked copy."""
        with reading_errors(path), path.open("rb") as file:
            if not file.read(len(ZSTD)).startswith(ZSTD):
                return path
            if self._unpacked is None:
                self._unpacked = Path(tempfile.mkdtemp(prefix="bot-console-bag-"))
                weakref.finalize(self, shutil.rmtree, self._unpacked, ignore_errors=True)
            return unpack_file(path, self._unpacked)

    def _open(self, file: Path, plain: Path) -> McapFile | SqliteFile:
        """Open a file; its format is recognised by the unpacked copy `plain`."""
        from bot_console.tui.console.bags.mcap_file import McapFile

        with reading_errors(file):
            with plain.open("rb") as opened:
                begin = opened.read(len(SQLITE))
            if begin.startswith(ROS1):
                raise BagError(
                    f"{file} is a bag of ROS 1; `rosbags-convert` of the package rosbags makes it one of ROS 2"
                )
            if begin == SQLITE or plain.suffix == ".db3":
                return SqliteFile(plain)
            if done := repair(plain, file):
                self.repaired.append(done)
            return McapFile(plain)

    def _add_to_metadata(self, file: Path, contents: McapFile | SqliteFile) -> None:
        """Add the contents of a file to the metadata."""
        part = FilePart(file.name)
        for topic in contents.topics():
            known = self.metadata.topics.setdefault(topic.name, replace(topic, count=0))
            known.count += topic.count
            part.count += topic.count
        for stamp in (contents.begin, contents.end) if part.count else ():
            if not 0 <= stamp <= LATEST_NS:
                raise BagError(f"{file} is damaged: a message is dated {stamp} ns since 1970")
            part.include(stamp)
        self.metadata.files.append(part)


def _files(path: Path, about: Mapping[str, Any]) -> list[Path]:
    if path.is_file():
        return [path]
    if not path.is_dir():
        raise BagError(f"{path}: no such bag")
    compression = str(about.get("compression_format") or "")
    if compression not in ("", "none", "zstd"):
        raise BagError(f"{path} is compressed with {compression}, which cannot be unpacked here; only zstd can")
    named = about.get("relative_file_paths")
    # earlier versions of rosbag2 wrote the bag's folder as well; a file outside of it is never read
    names = [Path(str(each)).name for each in cast("list[Any]", named)] if isinstance(named, list) else []
    there = {each.name: each for each in path.iterdir() if each.is_file() and each.resolve().parent == path.resolve()}
    found = [there[name] for name in names if name in there]
    found = found or sorted(each for pattern in PATTERNS for each in path.glob(pattern))
    if not found:
        raise BagError(f"{path}: the folder contains no .mcap and no .db3 file")
    return found


def _read_metadata(path: Path) -> Mapping[str, Any]:
    """The metadata of a folder; empty if it is missing or unreadable."""
    with suppress(OSError, *UNREADABLE):
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        about: Any = yaml.load((path / FILE).read_text(encoding="utf-8"), loader)["rosbag2_bagfile_information"]
        if isinstance(about, dict):
            return cast("dict[str, Any]", about)
    return {}


def _compression(about: Mapping[str, Any]) -> str:
    mode = str(about.get("compression_mode") or "").lower()
    return mode if mode in ("file", "message") else ""


def _custom(about: Mapping[str, Any]) -> dict[str, str]:
    custom = about.get("custom_data")
    facts = cast("dict[Any, Any]", custom) if isinstance(custom, dict) else {}
    return {str(key): str(value) for key, value in facts.items()}


def _messages(
    path: Path, contents: McapFile | SqliteFile, topics: Collection[str] | None, begin: int
) -> Iterator[Entry]:
    came = 0
    with reading_errors(path, lambda: f" after {came} messages"):
        for received, topic, data in contents.messages(topics, begin):
            if not 0 <= received <= LATEST_NS:
                raise ValueError(f"a message is dated {received} ns since 1970")
            came += 1
            yield Entry(received, topic, unpack_message(data))
