"""The `metadata.yaml` of a bag folder, in rosbag2's format (version 9, Jazzy)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import yaml
from bot_console.tui.files.save_file import save_file
from bot_console.tui.text.counted import counted
from bot_console.tui.text.yaml_faults import UNREADABLE

VERSION = 9
FILE = "metadata.yaml"


class _DumperWithoutAliases(yaml.SafeDumper):
    """Dumps YAML without aliases, which rosbag2's reader does not understand: equal objects are written out again."""

    def ignore_aliases(self, data: Any) -> bool:
        """Never write an alias."""
        return True


def qos_profiles(text: str) -> list[dict[str, Any]]:
    """Parse the QoS profiles of a topic's publishers from YAML; unreadable ones are ignored."""
    try:
        data = yaml.load(text or "[]", getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except UNREADABLE:
        return []
    found = cast("list[Any]", data) if isinstance(data, list) else []
    return [each for each in found if isinstance(each, dict)]


def metadata_yaml(data: object) -> str:
    """Dump block-style YAML that keeps the order of keys."""
    return yaml.dump(data, Dumper=_DumperWithoutAliases, sort_keys=False)


@dataclass
class Topic:
    """A topic of a bag: its type, its publishers' QoS, and its number of messages."""

    name: str
    type: str
    qos: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]])
    type_hash: str = ""
    count: int = 0
    encoding: str = "cdr"
    """The serialization format of its messages."""

    def check_encoding(self) -> None:
        """Raise `ValueError` unless its messages can be decoded."""
        if self.encoding != "cdr":
            raise ValueError(f"its messages are serialized as {self.encoding}, not as cdr")


@dataclass
class FilePart:
    """A file of a bag, with the times (ns since the epoch) and number of its messages."""

    path: str
    begin: int = 0
    end: int = 0
    count: int = 0

    def include(self, stamp: int) -> None:
        """Extend the times to include a message's time."""
        self.begin = min(self.begin or stamp, stamp)
        self.end = max(self.end, stamp)


@dataclass
class Metadata:
    """The metadata of a bag folder; times are in ns since the epoch."""

    files: list[FilePart]
    topics: dict[str, Topic] = field(default_factory=dict[str, Topic])
    storage: str = "mcap"
    """`mcap` or `sqlite3`."""
    compression: str = ""
    """`file` or `message`; empty if rosbag2 did not compress the bag."""
    custom: dict[str, str] = field(default_factory=dict[str, str])
    """Custom data given to the recorder."""

    @property
    def begin(self) -> int:
        """The time of the first message; 0 if there is none."""
        return min((each.begin for each in self.files if each.begin), default=0)

    @property
    def end(self) -> int:
        """The time of the last message; 0 if there is none."""
        return max((each.end for each in self.files), default=0)

    @property
    def amount(self) -> str:
        """The number of messages and of topics, in words."""
        return f"{counted(self.count, 'message')} of {counted(len(self.topics), 'topic')}"

    @property
    def count(self) -> int:
        """The number of messages."""
        return sum(each.count for each in self.topics.values())

    def save(self, folder: Path) -> None:
        """Write `metadata.yaml`; raises `NotSaved`."""
        save_file(folder / FILE, metadata_yaml({"rosbag2_bagfile_information": self._data()}))

    def _data(self) -> dict[str, Any]:
        times = _times(self.begin, self.end, self.count)
        return {
            "version": VERSION,
            "storage_identifier": self.storage,
            "duration": times["duration"],
            "starting_time": times["starting_time"],
            "message_count": self.count,
            "topics_with_message_count": list(_topics(self.topics.values())),
            "compression_format": "zstd" if self.compression else "",
            "compression_mode": self.compression.upper(),
            "relative_file_paths": [each.path for each in self.files],
            "files": [{"path": each.path, **_times(each.begin, each.end, each.count)} for each in self.files],
            "custom_data": self.custom or None,
            "ros_distro": "jazzy",
        }


def _times(begin: int, end: int, count: int) -> dict[str, Any]:
    return {
        "starting_time": {"nanoseconds_since_epoch": begin},
        "duration": {"nanoseconds": end - begin},
        "message_count": count,
    }


def _topics(topics: Iterable[Topic]) -> Iterable[dict[str, Any]]:
    for each in topics:
        yield {
            "topic_metadata": {
                "name": each.name,
                "type": each.type,
                "serialization_format": each.encoding,
                "offered_qos_profiles": each.qos,
                "type_description_hash": each.type_hash,
            },
            "message_count": each.count,
        }
