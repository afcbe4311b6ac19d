"""The `metadata.yaml` of a bag folder, in rosbag2's format (version 9, Jazzy)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from bot_console.tui.files.save_file import save_file

VERSION = 9
FILE = "metadata.yaml"


class _Plain(yaml.SafeDumper):
    """Repeats equal objects instead of writing YAML aliases, which rosbag2's reader does not understand."""

    def ignore_aliases(self, data: Any) -> bool:
        """Never write an alias."""
        return True


def metadata_yaml(data: object) -> str:
    """Block-style YAML that keeps the order of keys."""
    return yaml.dump(data, Dumper=_Plain, sort_keys=False)


@dataclass
class Topic:
    """A topic of a bag: its type, its publishers' QoS, and its number of messages."""

    name: str
    type: str
    qos: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]])
    type_hash: str = ""
    count: int = 0


@dataclass
class Metadata:
    """The metadata of a bag folder; times are in ns since the epoch."""

    file: str
    begin: int = 0
    end: int = 0
    topics: dict[str, Topic] = field(default_factory=dict[str, Topic])

    @property
    def count(self) -> int:
        """The number of messages."""
        return sum(each.count for each in self.topics.values())

    def seen(self, stamp: int) -> None:
        """Count a message received at that time."""
        self.begin = min(self.begin or stamp, stamp)
        self.end = max(self.end, stamp)

    def save(self, folder: Path) -> None:
        """Write the file; raises `NotSaved`."""
        save_file(folder / FILE, metadata_yaml({"rosbag2_bagfile_information": self._data()}))

    def _data(self) -> dict[str, Any]:
        times = {
            "starting_time": {"nanoseconds_since_epoch": self.begin},
            "duration": {"nanoseconds": self.end - self.begin},
            "message_count": self.count,
        }
        return {
            "version": VERSION,
            "storage_identifier": "mcap",
            "duration": times["duration"],
            "starting_time": times["starting_time"],
            "message_count": self.count,
            "topics_with_message_count": list(_topics(self.topics.values())),
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [self.file],
            "files": [{"path": self.file, **times}],
            "custom_data": None,
            "ros_distro": "jazzy",
        }


def _topics(topics: Iterable[Topic]) -> Iterable[dict[str, Any]]:
    for each in topics:
        yield {
            "topic_metadata": {
                "name": each.name,
                "type": each.type,
                "serialization_format": "cdr",
                "offered_qos_profiles": each.qos,
                "type_description_hash": each.type_hash,
            },
            "message_count": each.count,
        }
