"""The options of `ros2 bag` of Jazzy (rosbag2 0.26): all are accepted, and wrong combinations are explained."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import rclpy
from bot_console.tui.cli.bags import common, play
from bot_console.tui.cli.bags.keyboard import split_keys
from bot_console.tui.cli.bags.play_arguments import bag_paths, chosen_topics, end_time, play_problem
from bot_console.tui.cli.bags.record_arguments import record_problem, wanted_topics
from bot_console.tui.cli.verbs.bag import parser, run
from bot_console.tui.commanding.command_handler import CommandHandler
from bot_console.tui.console.bags.playing.player import Player
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.session.machine.ros import CAPABILITIES as MACHINE
from rclpy.serialization import serialize_message
from std_msgs.msg import Int32

pytest.importorskip("mcap")
FILE = __file__


def parsed(line: str) -> argparse.Namespace:
    return parser().parse_args(line.replace("FILE", FILE).split())


@pytest.mark.parametrize(
    "line",
    [
        "record -a",
        "record /scan /odom",
        "record -o out -s mcap --topics /scan /odom",
        "record --all-topics -s sqlite3",
        "record --all-services --exclude-services /a",
        "record --services /a /b -- /topic",
        "record --topic-types sensor_msgs/msg/LaserScan --exclude-topics /scan",
        "record -e /rob.* --exclude-regex /robot2 --exclude-topic-types a/msg/B",
        "record -a -x /rosout --include-hidden-topics --include-unpublished-topics",
        "record -a --no-discovery -p 200 --ignore-leaf-topics --qos-profile-overrides-path FILE",
        "record -a -f cdr -b 1000000 -d 60 --max-cache-size 1000",
        "record -a --disable-keyboard-controls --start-paused --node-name mine --log-level debug",
        "record -a --use-sim-time --custom-data a=1 b=2=3",
        "record -a --snapshot-mode --max-cache-size 1000",
        "record -a --storage-config-file FILE --storage-preset-profile zstd_fast",
        "record -a --compression-mode file --compression-format zstd --compression-threads 2",
        "record -a --compression-mode message --compression-threads-priority 3 --compression-queue-size 5",
    ],
)
def test_options_of_record_are_accepted(line: str) -> None:
    assert record_problem(parsed(line)) == ""


@pytest.mark.parametrize(
    "line",
    [
        "play bag",
        "play bag -s mcap -r 2.5 -l",
        "play bag -d 3 -p --start-offset 1.5",
        "play -i one -i two sqlite3",
        "play bag --input two mcap --read-ahead-queue-size 50",
        "play bag --topics /a /b --services /c -e /d -x /e --exclude-topics /f --exclude-services /g",
        "play bag --qos-profile-overrides-path FILE --storage-config-file FILE",
        "play bag --remap /a:=/b /c:=/d -m /e:=/f",
        "play bag --clock",
        "play bag --clock 100",
        "play bag --clock-topics /scan /odom",
        "play bag --clock-topics-all",
        "play bag --playback-duration 3.5 --playback-until-sec 1700000000.5",
        "play bag --playback-until-nsec 1700000000500000000",
        "play bag --disable-keyboard-controls --wait-for-all-acked 100 --disable-loan-message",
        "play bag --service-requests-source client_introspection --log-level warn",
        "burst bag -n 5 --start-offset 2 --topics /a -m /a:=/b",
    ],
)
def test_options_of_play_are_accepted(line: str) -> None:
    assert play_problem(parsed(line)) == ""


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("record", "Name topics"),
        ("record --topics /a --exclude-regex b", "--exclude-regex argument requires"),
        ("record --topics /a --all-services --exclude-topics /a", "--exclude-topics argument requires"),
        ("record --topics /a --exclude-topic-types b", "--exclude-topic-types argument requires"),
        ("record --all-topics --exclude-services /b", "--exclude-services argument requires"),
        ("record -a --use-sim-time --no-discovery", "/clock has to be found"),
        ("record -a --compression-format zstd", "needs a --compression-mode"),
        ("record -a --custom-data a", "takes KEY=VALUE, not 'a'"),
        ("play", "Name a bag"),
        ("play bag -i a b c", "--input takes a bag"),
        ("play -i a rosbag", "--input takes a bag"),
        ("play bag -m /a", "--remap takes OLD:=NEW, not '/a'"),
        ("play bag --publish-service-requests", "cannot be done here"),
    ],
)
def test_wrong_combinations_are_explained_on_one_line(
    line: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(line.split()) == 2
    out, err = capsys.readouterr()
    assert not out and message in err and len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("record -e ( -o x", "'(' is not a regular expression"),
        ("record -a -s rosbag", "invalid choice"),
        ("record -a --qos-profile-overrides-path none.yaml", "there is no file none.yaml"),
        ("play bag -d -1", "must not be negative"),
        ("play bag -r 0", "must be positive"),
        ("play bag --clock --clock-topics-all", "not allowed with"),
    ],
)
def test_impossible_values_are_refused(line: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        run(line.split())
    assert ended.value.code == 2 and message in capsys.readouterr().err


GRAPH = {
    "/scan": ["sensor_msgs/msg/LaserScan"],
    "/odom": ["nav_msgs/msg/Odometry"],
    "/_hidden/state": ["std_msgs/msg/String"],
    "/add/_service_event": ["example_interfaces/srv/AddTwoInts_Event"],
    "/only_subscribed": ["std_msgs/msg/String"],
    "/leaf": ["std_msgs/msg/String"],
}


@pytest.mark.parametrize(
    ("line", "recorded"),
    [
        ("-a", "/scan /odom /leaf /add/_service_event"),
        ("--all-topics", "/scan /odom /leaf"),
        ("--all-services", "/add/_service_event"),
        ("--services add", "/add/_service_event"),
        ("scan", "/scan"),
        ("--topics /_hidden/state", "/_hidden/state"),
        ("--topics /only_subscribed", ""),
        ("-a --include-hidden-topics", "/scan /odom /leaf /add/_service_event /_hidden/state"),
        ("--all-topics --include-unpublished-topics", "/scan /odom /leaf /only_subscribed"),
        ("--all-topics --ignore-leaf-topics", "/scan /odom"),
        ("-e /(scan|add)", "/scan /add/_service_event"),
        ("--topic-types nav_msgs/msg/Odometry std_msgs/msg/String", "/odom /leaf"),
        ("-a --exclude-topics /odom --exclude-services /add --exclude-topic-types std_msgs/msg/String", "/scan"),
        ("-a -x od|leaf", "/scan /add/_service_event"),
    ],
)
def test_topics_are_recorded_by_name_type_and_pattern(line: str, recorded: str) -> None:
    given = parsed(f"record {line}")
    assert record_problem(given) == ""
    wanted = wanted_topics(given, "/only_subscribed".__ne__, "/leaf".__ne__)
    assert {name for name, types in GRAPH.items() if wanted(name, types)} == set(recorded.split())


@pytest.mark.parametrize(
    ("line", "named", "played"),
    [
        ("", None, {"/scan", "/odom", "/add/_service_event"}),
        ("--topics scan", ["scan"], {"/scan", "/odom", "/add/_service_event"}),
        ("--services /add", ["/add/_service_event"], {"/scan", "/odom", "/add/_service_event"}),
        ("-e sc", None, {"/scan"}),
        ("-x sc --exclude-services add", None, {"/odom"}),
        ("--exclude-topics odom", None, {"/scan", "/add/_service_event"}),
    ],
)
def test_topics_are_played_by_name_and_pattern(line: str, named: Sequence[str] | None, played: set[str]) -> None:
    found, chosen = chosen_topics(parsed(f"play bag {line}"))
    assert found == named
    assert {each for each in ("/scan", "/odom", "/add/_service_event") if chosen(each)} == played


def test_play_ends_at_the_later_of_two_ends() -> None:
    assert end_time(parsed("play b"), 100) is None
    assert end_time(parsed("play b --playback-duration 2 --start-offset 1"), 100) == 3 * 10**9 + 100
    assert end_time(parsed("play b --playback-duration 1 --playback-until-nsec 5000000000"), 100) == 5 * 10**9
    assert end_time(parsed("play b --playback-until-sec 1.5"), 0) == 1_500_000_000
    assert bag_paths(parsed("play a -i b -i c mcap")) == [Path("a"), Path("b"), Path("c")]


def test_options_that_change_nothing_are_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["play", "none", "--storage", "mcap", "--read-ahead-queue-size", "5", "--disable-loan-message"]) == 1
    lines = capsys.readouterr().err.splitlines()
    ignored = [line for line in lines if re.match("--[a-z-]+ is ignored: ", line)]
    assert len(ignored) == 3 and len(lines) == 4 and "no such bag" in lines[-1]


def test_keys_of_the_terminal_are_recognised() -> None:
    read = b" \x1b[C\x1bOAq\x1b[6~\x1b[99X"
    assert list(split_keys(read)) == ["space", "right", "up", "q", "pagedown"]


def test_plugins_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "storage"]) == 0 and capsys.readouterr().out.split() == ["mcap", "sqlite3"]
    assert run(["list", "compression", "--verbose"]) == 0
    assert "name: rosbag2_compression_zstd::ZstdCompressor" in capsys.readouterr().out


def test_playing_into_the_ros2_of_a_machine_without_one_says_what_is_missing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("bot_console.tui.cli.verbs.bag.find_machine_ros", lambda: None)
    for verb in ("play", "burst", "open"):
        assert run([verb, "a_bag", "--ros"]) == 1
        assert "--ros needs a ROS 2 on this machine" in capsys.readouterr().err


def test_a_node_of_the_machines_ros2_does_not_join_the_domain_of_this_program(monkeypatch: pytest.MonkeyPatch) -> None:
    def unreachable() -> str:
        return "nothing is reached"

    monkeypatch.setattr(common, "reach_system", unreachable)
    assert common.join_domain() == "nothing is reached"
    rclpy.init()
    monkeypatch.setattr(rclpy, "init", lambda args: None)
    try:
        assert common.join_domain("player", machine=True).get_name() == "player"
    finally:
        rclpy.try_shutdown()


@pytest.mark.parametrize("play", [False, True])
def test_a_console_plays_bags_into_the_system_that_it_shows(play: bool) -> None:
    ran: list[Sequence[str]] = []
    snapshot = ConsoleSnapshot(capabilities=MACHINE)
    handler: Any = SimpleNamespace(
        _console=SimpleNamespace(snapshot=lambda: snapshot), _run_outside=lambda words: ran.append(words) or 0
    )
    CommandHandler.show_bag(handler, "a_bag", play=play)
    assert [*ran[0][-4:]] == (["open", "a_bag", "--play", "--ros"] if play else ["bag", "open", "a_bag", "--ros"])


@pytest.fixture
def played_bag(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The folder of a bag of nine seconds, to be played in this process without a robot."""
    writer = BagWriter(tmp_path / "bag")
    writer.topic("/number", Int32, [])
    for second in range(10):
        writer.write("/number", serialize_message(Int32(data=second)), (1_700_000_000 + second) * 10**9, 0)
    writer.close()
    monkeypatch.setattr(common, "reach_system", lambda: "")
    monkeypatch.setattr(Player, "await_subscriptions", lambda *_: None)
    yield str(tmp_path / "bag")
    rclpy.try_shutdown()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("--start-offset 1000", "--start-offset 1000: the bag ends after 9.0 s"),
        ("--playback-until-sec 5", "before the first message, which is at 1700000000.000 s since the epoch"),
    ],
)
def test_options_that_leave_nothing_to_play_are_refused(
    played_bag: str, options: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["play", played_bag, *options.split()]) == 2
    err = capsys.readouterr().err
    assert message in err and len(err.splitlines()) == 1


def test_topics_that_the_bag_does_not_contain_are_named(played_bag: str, capfd: pytest.CaptureFixture[str]) -> None:
    words = "--rate 1000 --disable-keyboard-controls --topics /number /scann --remap /odm:=/odom"
    assert run(["play", played_bag, *words.split()]) == 0
    shown = capfd.readouterr().err
    assert "Topic '/scann' is not in the bag" in shown and "Topic '/odm' is not in the bag" in shown
    assert "10 messages published" in shown and "'/number' is not" not in shown


def test_an_interrupted_player_does_not_wait_for_acknowledgements(
    played_bag: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(play, "spin", lambda *_: rclpy.shutdown())
    words = ["--start-paused", "--disable-keyboard-controls", "--wait-for-all-acked", "0"]
    assert run(["play", played_bag, *words]) == 0
    assert "0 messages published" in capsys.readouterr().err
