"""The ways to write bags: storages, several files, compression, additional metadata, conversion and reindexing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.cli.verbs import bag as verb
from bot_console.tui.console.bags.metadata import Metadata, Topic
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter, WritingOptions
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Int32, String

pytest.importorskip("mcap")
SECOND = 10**9
COUNT = 20


def write_bag(folder: Path, **how: Any) -> Path:
    """A bag with a number each second, and a word at its start."""
    writer = BagWriter(folder, WritingOptions(**how))
    writer.topic("/number", Int32, [])
    writer.topic("/word", String, [])
    writer.write("/word", serialize_message(String(data="hello")), SECOND, 0)
    for number in range(COUNT):
        writer.write("/number", serialize_message(Int32(data=number)), (number + 1) * SECOND, 0)
    writer.close()
    return folder


def test_amount_of_a_bag_is_in_words() -> None:
    one = Metadata([], {"/word": Topic("/word", "std_msgs/msg/String", count=1)})
    assert one.amount == "1 message of 1 topic"
    assert Metadata([]).amount == "0 messages of 0 topics"


def numbers(bag: Bag) -> list[int]:
    return [deserialize_message(each.data, Int32).data for each in bag.messages(["/number"])]


def by_rosbags(folder: Path) -> list[int]:
    """Read the same bag with another library."""
    highlevel = pytest.importorskip("rosbags.highlevel")
    with highlevel.AnyReader([folder]) as reader:
        assert reader.message_count == COUNT + 1
        connections = [each for each in reader.connections if each.topic == "/number"]
        return [reader.deserialize(data, each.msgtype).data for each, _, data in reader.messages(connections)]


@pytest.mark.parametrize(("preset", "compressed"), [("zstd_fast", True), ("zstd_small", True), ("fastwrite", False)])
def test_chunks_are_compressed_as_the_preset_says(tmp_path: Path, preset: str, compressed: bool) -> None:
    (file,) = write_bag(tmp_path / "bag", storage="mcap", preset=preset).glob("*.mcap")
    assert (b"zstd" in file.read_bytes()) == compressed


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize(
    "how",
    [
        {},
        {"max_seconds": 5},
        {"compression": "message"},
        {"compression": "file", "max_seconds": 8},
        {"max_bytes": 200, "custom": {"who": "me"}},
        {"preset": "zstd_small"},
        pytest.param({"preset": "fastwrite"}, marks=pytest.mark.slow),
    ],
    ids=str,
)
def test_written_bag_is_read_here_and_by_another_library(tmp_path: Path, storage: str, how: dict[str, Any]) -> None:
    folder = write_bag(tmp_path / "bag", storage=storage, **how)
    bag = Bag(folder)
    assert numbers(bag) == by_rosbags(folder) == list(range(COUNT)) and bag.storage == storage
    assert bag.metadata.count == COUNT + 1 and bag.metadata.custom == how.get("custom", {})
    assert (len(bag.files) > 1) == ("max_seconds" in how or "max_bytes" in how)
    assert sum(each.count for each in bag.metadata.files) == COUNT + 1
    assert all((each.suffix == ".zstd") == (how.get("compression") == "file") for each in bag.files)


def test_a_bag_is_reindexed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_bag(tmp_path / "bag", max_seconds=5, compression="message", custom={"a": "1"})
    metadata = folder / "metadata.yaml"
    before = metadata.read_text()
    metadata.write_text(before.replace("- bag_1.mcap", ""))
    assert verb.run(["reindex", str(folder)]) == 0 and f"{COUNT + 1} messages" in capsys.readouterr().out
    assert metadata.read_text() == before
    metadata.unlink()
    assert verb.run(["reindex", str(folder), "-s", "mcap"]) == 0 and numbers(Bag(folder)) == list(range(COUNT))
    assert verb.run(["reindex", str(tmp_path / "none")]) == 1


def test_bags_are_converted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bag(tmp_path / "one")
    write_bag(tmp_path / "two", storage="sqlite3")
    (tmp_path / "out.yaml").write_text(
        f"""
        output_bags:
        - {{uri: {tmp_path}/all, all: true, storage_id: sqlite3, max_cache_size: 5}}
        - {{uri: {tmp_path}/words, topics: [/word], compression_mode: file, compression_format: zstd}}
        - {{uri: {tmp_path}/rest, exclude_regex: word, max_bagfile_duration: 4}}
        """
    )
    line = ["convert", "-i", f"{tmp_path}/one", "-i", f"{tmp_path}/two", "sqlite3", "-o", f"{tmp_path}/out.yaml"]
    assert verb.run(line) == 0
    assert "max_cache_size" in capsys.readouterr().err
    every, words, rest = (Bag(tmp_path / name) for name in ("all", "words", "rest"))
    assert (every.metadata.count, every.storage) == (2 * COUNT + 2, "sqlite3")
    assert (words.metadata.count, words.files[0].suffix) == (2, ".zstd")
    assert rest.metadata.count == 2 * COUNT and len(rest.files) == 5 and list(rest.topics) == ["/number"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: [", "is not YAML"),
        ("5", "has to list"),
        ("output_bags: [{}]", "each with a"),
        ("", "has to list"),
        *(
            (f"output_bags: [{{uri: out, {name}: {value}}}]", f"out: {name} cannot be")
            for name, value in {
                "max_bagfile_size": ".inf",
                "max_bagfile_duration": "[1]",
                "custom_data": "5",
                "topics": "true",
            }.items()
        ),
        ("output_bags: [{uri: out, storage_id: rosbag}]", "out: storage_id must be mcap or sqlite3, not 'rosbag'"),
        ("output_bags: [{uri: out, compression_mode: zip}]", "out: compression_mode must be none or file or message"),
        ("output_bags: [{uri: out, regex: '('}]", "out: regex '(' is not a regular expression"),
        ("output_bags: [{uri: out, exclude: '['}]", "out: exclude '[' is not a regular expression"),
    ],
)
def test_wrong_output_options_are_explained(
    tmp_path: Path, text: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    write_bag(tmp_path / "one")
    (tmp_path / "out.yaml").write_text(text)
    assert verb.run(["convert", "-i", str(tmp_path / "one"), "-o", str(tmp_path / "out.yaml")]) == 1
    err = capsys.readouterr().err
    assert message in err and len(err.splitlines()) == 1


def test_a_missing_file_of_output_options_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert verb.run(["convert", "-i", str(tmp_path / "one"), "-o", str(tmp_path / "out.yaml")]) == 1
    assert capsys.readouterr().err == f"{tmp_path}/out.yaml: No such file or directory\n"


def test_two_bags_after_one_input_option_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert verb.run(["convert", "-i", "one", "two", "-o", str(tmp_path / "out.yaml")]) == 2
    assert "for several bags repeat --input" in capsys.readouterr().err


def test_info_lists_services_and_names(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from bot_console.tui.console.bags.metadata import Topic

    folder = tmp_path / "bag"
    writer = BagWriter(folder, WritingOptions(custom={"who": "me"}))
    writer.topic("/word", String, [])
    writer.add(Topic("/add/_service_event", "example_interfaces/srv/AddTwoInts_Event"), "")
    for code in (0, 1, 2, 3, 3):
        writer.write("/add/_service_event", bytes([0, 1, 0, 0, code]), SECOND, 0)
    writer.close()
    assert verb.run(["info", str(folder), "-v"]) == 0
    out = capsys.readouterr().out
    assert (
        "Service: /add | Service Type: example_interfaces/srv/AddTwoInts | Request Count: 2 | Response Count: 3" in out
    )
    assert "Topic: /word" in out and "Topic: /add" not in out and "who=me" in out
    assert verb.run(["info", "-t", str(folder)]) == 0 and capsys.readouterr().out == "/word\n"
