"""Bags written by other programs: compressed, without an index, in parts; and files that only look like bags."""

from __future__ import annotations

import re
import sqlite3
import struct
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.cli.verbs import bag as verb
from bot_console.tui.console.bags import compression
from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.bags.damage import BagError
from bot_console.tui.console.bags.definitions import definition
from bot_console.tui.console.bags.reader import Bag
from rclpy.serialization import deserialize_message, serialize_message
from sampling import slow_after
from std_msgs.msg import String

mcap_writer = pytest.importorskip("mcap.writer")
zstandard = pytest.importorskip("zstandard")
Compression, Index = mcap_writer.CompressionType, mcap_writer.IndexType
BEGIN = 1_700_000_000_000_000_000
COUNT = 60


def text(number: int) -> bytes:
    return serialize_message(String(data=f"{number} {'x' * 50}"))


def numbers(bag: Bag, topics: list[str] | None = None, begin: int = 0) -> list[int]:
    return [int(deserialize_message(each.data, String).data.split()[0]) for each in bag.messages(topics, begin)]


def write_mcap(path: Path, order: list[int] | None = None, schema: str = "std_msgs/msg/String", **options: Any) -> Path:
    """A file of `COUNT` messages on two topics."""
    with path.open("wb") as file:
        writer = mcap_writer.Writer(file, **{"chunk_size": 600, **options})
        writer.start(profile="ros2", library="another")
        kind = writer.register_schema(name=schema, encoding="ros2msg", data=definition(String).encode())
        even, odd = (writer.register_channel(topic, "cdr", kind) for topic in ("/even", "/odd"))
        for number in order or range(COUNT):
            stamp = BEGIN + number
            writer.add_message(odd if number % 2 else even, log_time=stamp, data=text(number), publish_time=stamp)
        writer.finish()
    return path


def drop_summary(path: Path) -> Path:
    """The same file as written by a program that writes no summary."""
    whole = path.read_bytes()
    (summary,) = struct.unpack_from("<Q", whole, len(whole) - 28)
    data_end = whole.rindex(b"\x0f" + struct.pack("<Q", 4), 0, summary or len(whole))
    path.write_bytes(whole[: data_end + 13] + b"\x02" + struct.pack("<QQQI", 20, 0, 0, 0) + whole[-8:])
    return path


NO_CRC = {"enable_crcs": False}
OPTIONS: dict[str, dict[str, Any]] = {
    "as written by default": {},
    "lz4": {"compression": Compression.LZ4},
    "not compressed": {"compression": Compression.NONE},
    "without CRC": NO_CRC,
    "without chunks": {"use_chunking": False},
    "without statistics": {"use_statistics": False},
    "without index": {"index_types": Index.NONE},
    "without index of messages": {"index_types": Index.CHUNK},
    "without channels in the summary": {"repeat_channels": False},
    "without schemas in the summary": {"repeat_schemas": False},
    "bare": {
        "use_chunking": False, "use_statistics": False, "index_types": Index.NONE, "repeat_channels": False,
        "repeat_schemas": False, "use_summary_offsets": False, **NO_CRC,
    },
    "bare chunks": {
        "use_statistics": False, "index_types": Index.NONE, "repeat_channels": False, "repeat_schemas": False,
        "use_summary_offsets": False, **NO_CRC,
    },
}  # fmt: skip


@pytest.mark.parametrize("summary", [True, False], ids=["", "and without summary"])
@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS.keys())
def test_mcap_is_read_whatever_its_writer_left_out(tmp_path: Path, options: dict[str, Any], summary: bool) -> None:
    path = write_mcap(tmp_path / "a.mcap", **options)
    bag = Bag(path if summary else drop_summary(path))
    assert {name: (each.type, each.count) for name, each in bag.metadata.topics.items()} == {
        "/even": ("std_msgs/msg/String", COUNT // 2),
        "/odd": ("std_msgs/msg/String", COUNT // 2),
    }
    assert (bag.metadata.begin, bag.metadata.end) == (BEGIN, BEGIN + COUNT - 1) and not bag.repaired
    assert numbers(bag) == list(range(COUNT))
    assert numbers(bag, ["/odd"], BEGIN + 20) == list(range(21, COUNT, 2))


@pytest.mark.parametrize("chunked", [True, False])
@pytest.mark.parametrize("summary", [True, False])
def test_messages_are_sorted_by_time(tmp_path: Path, chunked: bool, summary: bool) -> None:
    order = [*range(0, COUNT, 3), *range(1, COUNT, 3), *range(COUNT - 1, 0, -3)]
    path = write_mcap(tmp_path / "a.mcap", order, use_chunking=chunked)
    assert numbers(Bag(path if summary else drop_summary(path))) == list(range(COUNT))


def test_a_cut_file_without_index_is_repaired_and_read(tmp_path: Path) -> None:
    path = write_mcap(tmp_path / "a.mcap", use_chunking=False)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    bag = Bag(path)
    found = numbers(bag)
    assert len(bag.repaired) == 1 and found == list(range(len(found))) and len(found) > COUNT / 4


def test_types_without_msg_and_other_encodings_are_recognised(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert Bag(write_mcap(tmp_path / "a.mcap", schema="std_msgs/String")).metadata.topics["/odd"].type == (
        "std_msgs/msg/String"
    )
    with (tmp_path / "b.mcap").open("wb") as file:
        writer = mcap_writer.Writer(file)
        writer.start()
        writer.add_message(writer.register_channel("/json", "json", 0), BEGIN, b"{}", BEGIN)
        writer.finish()
    contents = Contents(Bag(tmp_path / "b.mcap"))
    with pytest.raises(ValueError, match="serialized as json, not as cdr"):
        contents.message("/json", 0)
    verb.run(["info", str(tmp_path / "b.mcap")])
    assert "Serialization Format: json" in capsys.readouterr().out


def rosbags_bag(folder: Path, mode: str, storage: str) -> Path:
    """A bag written by the library rosbags."""
    rosbag2 = pytest.importorskip("rosbags.rosbag2")
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    writer = rosbag2.Writer(folder, version=9, storage_plugin=rosbag2.StoragePlugin[storage])
    if mode:
        writer.set_compression(rosbag2.CompressionMode[mode], rosbag2.CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection("/odd", "std_msgs/msg/String", typestore=store)
        for number in range(COUNT):
            writer.write(connection, BEGIN + number, text(number))
    return folder


@pytest.mark.parametrize("storage", ["SQLITE3", "MCAP"])
@pytest.mark.parametrize("mode", ["", "FILE", "MESSAGE"])
@pytest.mark.parametrize("metadata", slow_after(1, [True, False]))
def test_bags_compressed_by_file_or_message_are_read(tmp_path: Path, mode: str, storage: str, metadata: bool) -> None:
    folder = rosbags_bag(tmp_path / "bag", mode, storage)
    if not metadata:
        (folder / "metadata.yaml").unlink()
    bag = Bag(folder)
    assert numbers(bag) == list(range(COUNT)) and bag.metadata.topics["/odd"].count == COUNT
    assert numbers(Bag(bag.files[0])) == list(range(COUNT))
    assert bag.storage == storage.lower() and {each.suffix for each in folder.iterdir()} <= {
        ".yaml", ".zstd", ".db3", ".mcap",
    }  # fmt: skip


def test_chunks_compressed_by_the_storage_are_read(tmp_path: Path) -> None:
    assert numbers(Bag(rosbags_bag(tmp_path / "bag", "STORAGE", "MCAP"))) == list(range(COUNT))


def test_all_files_of_a_repaired_bag_remain_in_its_metadata(tmp_path: Path) -> None:
    write_mcap(tmp_path / "bag_0.mcap", list(range(30)))
    path = write_mcap(tmp_path / "bag_1.mcap", list(range(30, COUNT)))
    path.write_bytes(path.read_bytes()[:-20])
    assert len(Bag(tmp_path).repaired) == 1
    again = Bag(tmp_path)
    assert numbers(again) == list(range(COUNT)) and [each.count for each in again.metadata.files] == [30, 30]


def test_the_tables_of_early_versions_are_read(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "bag_0.db3") as base:
        base.execute("create table topics (id integer primary key, name, type, serialization_format)")
        base.execute("create table messages (id integer primary key, topic_id, timestamp, data)")
        base.execute("insert into topics values (1, '/odd', 'std_msgs/msg/String', 'cdr')")
        base.execute("insert into messages (topic_id, timestamp, data) values (1, ?, ?)", (BEGIN, text(7)))
    (tmp_path / "metadata.yaml").write_text(
        f"rosbag2_bagfile_information: {{version: 3, relative_file_paths: [{tmp_path.name}/bag_0.db3]}}"
    )
    assert numbers(Bag(tmp_path)) == [7]


def zstd_bomb(size: int, *, declared: bool) -> bytes:
    compressor = zstandard.ZstdCompressor(write_content_size=declared).compressobj(size=size if declared else -1)
    piece = bytes(1024**2)
    return b"".join([*(compressor.compress(piece) for _ in range(size // len(piece))), compressor.flush()])


def chunk_file(path: Path, compression: str, data: bytes, size: int) -> Path:
    """An MCAP file with one chunk that claims to unpack to a size."""
    name = compression.encode()
    head = struct.pack("<QQQII", BEGIN, BEGIN, size, 0, len(name)) + name + struct.pack("<Q", len(data))
    header = b"\x01" + struct.pack("<Q", 8) + bytes(8)
    chunk = b"\x06" + struct.pack("<Q", len(head) + len(data)) + head + data
    magic = b"\x89MCAP0\r\n"
    path.write_bytes(magic + header + chunk + b"\x02" + struct.pack("<QQQI", 20, 0, 0, 0) + magic)
    return path


@pytest.fixture
def small_parts(monkeypatch: pytest.MonkeyPatch) -> int:
    """The size that chunks and messages may have."""
    monkeypatch.setattr(compression, "MAX_PART_BYTES", 4 * 1024**2)
    return compression.MAX_PART_BYTES


@pytest.mark.parametrize("claimed", [lambda _: 100, lambda maximum: maximum, lambda _: 2**62])
@pytest.mark.parametrize("how", ["zstd", "zstd, size in its header", "lz4"])
def test_a_chunk_that_unpacks_to_far_more_is_refused(tmp_path: Path, small_parts: int, how: str, claimed: Any) -> None:
    import lz4.frame

    size = 3 * small_parts
    data = lz4.frame.compress(bytes(size)) if how == "lz4" else zstd_bomb(size, declared=how != "zstd")
    with pytest.raises(BagError, match=r"unpacks to more than|bytes instead of"):
        Bag(chunk_file(tmp_path / "a.mcap", how.partition(",")[0], data, claimed(small_parts)))


@pytest.mark.parametrize("declared", [True, False])
def test_a_message_that_unpacks_to_far_more_is_refused(tmp_path: Path, small_parts: int, declared: bool) -> None:
    with (tmp_path / "a.mcap").open("wb") as file:
        writer = mcap_writer.Writer(file)
        writer.start()
        channel = writer.register_channel("/odd", "cdr", 0)
        writer.add_message(channel, BEGIN, zstd_bomb(3 * small_parts, declared=declared), BEGIN)
        writer.finish()
    bag = Bag(tmp_path / "a.mcap")
    with pytest.raises(BagError, match="a message unpacks to more than 4 MiB"):
        list(bag.messages())


def test_a_file_that_unpacks_to_far_more_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compression, "FREE_BYTES", 10 * 1024**2)
    (tmp_path / "bag_0.db3.zstd").write_bytes(zstd_bomb(50 * 1024**2, declared=False))
    with pytest.raises(BagError, match="unpacks to more than 10 MiB"):
        Bag(tmp_path)


def test_a_damaged_byte_anywhere_in_a_file_without_index_is_reported_or_changes_little(tmp_path: Path) -> None:
    path = drop_summary(write_mcap(tmp_path / "a.mcap", list(range(4)), compression=Compression.ZSTD))
    whole, reported = path.read_bytes(), 0
    for place in range(0, len(whole), 3):
        path.write_bytes(whole[:place] + b"\xff" + whole[place + 1 :])
        try:
            reported += bool(Contents(Bag(path)).damage)
        except BagError:
            reported += 1
    assert reported > 20


UNREADABLE = {
    "not an MCAP file": ("a.mcap", b"nothing"),
    "is a bag of ROS 1": ("a.bag", b"#ROSBAG V2.0\n" + bytes(50)),
    "not a database": ("a.db3", b"nothing at all of the kind"),
    "no such table": ("a.db3", b""),
    "it ends after": ("a.db3.zstd", zstandard.ZstdCompressor().compress(bytes(range(256)) * 4)[:-5]),
    "is not known here": ("a.mcap", b""),
}
"""The reported text, a file name, and the content of the file."""


@pytest.mark.parametrize("words", [["info"], ["play"], ["open"]])
@pytest.mark.parametrize("problem", UNREADABLE)
def test_a_bag_that_cannot_be_read_ends_with_one_line_and_a_code(
    tmp_path: Path, words: list[str], problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    name, content = UNREADABLE[problem]
    path = tmp_path / name
    path.write_bytes(content)
    if problem == "is not known here":
        chunk_file(path, "brotli", b"", 0)
    assert verb.run([*words, str(path)]) == 1
    out, err = capsys.readouterr()
    assert not out and len(err.splitlines()) == 1 and re.search(problem, err) and str(path) in err


def test_a_bag_of_which_nothing_can_be_read_is_not_opened(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_mcap(tmp_path / "a.mcap", compression=Compression.NONE, chunk_size=100_000)
    whole = path.read_bytes()
    at = whole.index(b"\x06", 8) + 9 + 16
    path.write_bytes(whole[:at] + struct.pack("<Q", 5) + whole[at + 8 :])
    assert verb.run(["open", str(path)]) == 1
    assert "a.mcap is damaged after 0 messages" in capsys.readouterr().err
