"""Parsers of recordings: each function feeds a text to one of them, as bytes where the file is not text."""

from __future__ import annotations

import argparse
import io
import shutil
import sqlite3
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing, redirect_stdout, suppress
from functools import cache
from pathlib import Path
from typing import Any

from files import FOLDER, file

RECORDED_ID = "a1b2c3"
"""The id of the stop in the bags with control topics."""


def bag(suffix: str) -> Callable[[str], None]:
    def run(text: str) -> None:
        from bot_console.tui.cli.bags.info import info
        from bot_console.tui.console.bags.contents import Contents
        from bot_console.tui.console.bags.opened_bag import OpenedBag
        from bot_console.tui.console.bags.reader import Bag

        folder = FOLDER / f"bag{suffix}"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        (folder / f"a{suffix}").write_bytes(text.encode("latin-1", "replace"))
        with redirect_stdout(io.StringIO()):
            info(argparse.Namespace(bag=folder, topic_name=False, verbose=True))
        console = OpenedBag(Contents(Bag(folder)), "bag")
        for topic in console.topics.measured():
            console.topics.listen(topic)
            console.topics.heard()
        for path in console.plots.plottable():
            console.plots.watch(path)
        console.close()

    return run


@cache
def node() -> Any:
    import rclpy

    rclpy.init()
    return rclpy.create_node("fuzz")


def control_bag(suffix: str) -> Callable[[str], None]:
    """Check that playing a recording neither moves a robot nor releases a stop."""

    def run(text: str) -> None:
        from bot_console.tui.console.bags.definitions import class_of
        from bot_console.tui.console.bags.playing.control_topics import controls, left_out_warning
        from bot_console.tui.console.bags.playing.player import PlaybackOptions, Player
        from bot_console.tui.console.bags.reader import Bag

        path = FOLDER / f"control{suffix}"
        path.write_bytes(text.encode("latin-1", "replace"))
        bag = Bag(path)
        player = Player(node(), bag, PlaybackOptions(), class_of)
        played = {each for each in bag.topics if each not in player.left_out and each not in player.unknown}
        for each in player._publishers.values():
            node().destroy_publisher(each)
        assert not [each for each in played if "emergency_stop" in each.split("/")[:-1] or each == "/cmd_vel"]
        assert not [each for each in played if controls(each, bag.topics[each].type)]
        left_out_warning(player.left_out).encode()
        held_through(entry.data for entry in bag.messages())

    return run


def held_through(recorded: Iterable[bytes]) -> None:
    """Feed recorded messages to a lock that holds a robot, as requests and as states of the other lock."""
    from bot_console_robot.safety.latch import STOP, Latch, Request
    from bot_console_robot.safety.stop_messages import parse_request, parse_state
    from diagnostic_msgs.msg import DiagnosticStatus
    from rclpy.serialization import deserialize_message

    asked, followed = Latch(), Latch()
    asked.request(Request(STOP, "anna", "why", "k", RECORDED_ID), 0)
    followed.request(Request(STOP, "anna", "why", "k", "never recorded"), 0)
    for data in recorded:
        try:
            message = deserialize_message(data, DiagnosticStatus)
        except RuntimeError:
            continue
        asked.request(parse_request(message), 1)
        followed.follow(parse_state(message).lock)
    assert RECORDED_ID in asked.lock.ids, "a recorded request has released the stop"
    assert "never recorded" in followed.lock.ids, "a recorded state has released the stop"


def control_seeds(storage: str) -> Callable[[], Sequence[str]]:
    """Bags of a stop, its release and the states of the locks, together with commands and a harmless topic."""

    def seeds() -> Sequence[str]:
        from bot_console.tui.console.bags.writer import BagWriter, WritingOptions
        from bot_console_robot.safety.latch import RELEASE, STOP, Latch, Request
        from bot_console_robot.safety.stop_messages import State, request_message, state_message
        from geometry_msgs.msg import Twist
        from rclpy.serialization import serialize_message
        from std_msgs.msg import Bool, String

        latch = Latch()
        stop = Request(STOP, "anna", "why", "k", RECORDED_ID)
        latch.request(stop, 0)
        held = state_message(State(latch.lock, "1", latch.challenge), "safety_monitor")
        release = Request(RELEASE, "anna", "", "k", ids=(RECORDED_ID,), challenges=(latch.challenge,), of=("k",))
        latch.request(release, 0)
        free = state_message(State(latch.lock, "1", latch.challenge), "safety_monitor")
        recorded: list[tuple[str, Any]] = [
            ("/emergency_stop/request", request_message(stop)),
            ("/emergency_stop/arbiter", held),
            ("/robot2/emergency_stop/request", request_message(release)),
            ("/emergency_stop/base", free),
            ("/cmd_vel", Twist()),
            ("/e_stop", Bool(data=True)),
            ("/chatter", String(data="a")),
        ]
        folder = FOLDER / f"control-seed-{storage}"
        writer = BagWriter(folder, WritingOptions(storage=storage))
        for number, (topic, message) in enumerate(recorded):
            writer.topic(topic, type(message), [{"depth": 10, "durability": "transient_local"}])
            writer.write(topic, serialize_message(message), 10**9 + number, 10**9 + number)
        writer.close()
        return [next(each for each in folder.iterdir() if each.suffix != ".yaml").read_bytes().decode("latin-1")]

    return seeds


def metadata(text: str) -> None:
    from bot_console.tui.console.bags.damage import BagError
    from bot_console.tui.console.bags.metadata import qos_profiles
    from bot_console.tui.console.bags.reader import _files

    folder = file(text, "metadata.yaml").parent
    with suppress(BagError):
        _files(folder, {})
    qos_profiles(text)


def saved_log(text: str) -> None:
    from bot_console.tui.console.logs.saved import SavedLines

    records: list[tuple[int, int, str, str]] = []
    lines = SavedLines(lambda *each: records.append(each), "n")
    lines.feed(text)
    lines.settle()
    assert all(0 <= stamp < 2**63 for stamp, *_ in records)


def mcap_seeds() -> Sequence[str]:
    from bot_console.tui.console.bags.writer import BagWriter
    from builtin_interfaces.msg import Time
    from nav_msgs.msg import MapMetaData, OccupancyGrid, Odometry
    from rcl_interfaces.msg import Log, Parameter, ParameterEvent, ParameterValue
    from rclpy.serialization import serialize_message

    changed = [Parameter(name="max_speed", value=ParameterValue(type=3, double_value=1.0))]
    messages = {
        "/map": OccupancyGrid(info=MapMetaData(width=2, height=1, resolution=0.5), data=[0, 100]),
        "/odom": Odometry(),
        "/parameter_events": ParameterEvent(node="/nav", changed_parameters=changed),
        "/rosout": Log(stamp=Time(sec=1), level=30, name="nav", msg="too fast"),
    }
    folder = FOLDER / "seed"
    writer = BagWriter(folder)
    for number, (topic, message) in enumerate(messages.items()):
        writer.topic(topic, type(message), [{"depth": 10}])
        writer.write(topic, serialize_message(message), 10**9 + number, 10**9 + number)
    writer.close()
    return [next(folder.glob("*.mcap")).read_bytes().decode("latin-1")]


def sqlite_seeds() -> Sequence[str]:
    path = FOLDER / "seed.db3"
    with closing(sqlite3.connect(path)) as base:
        base.execute("create table topics (id integer, name text, type text, offered_qos_profiles text)")
        base.execute("create table messages (id integer, topic_id integer, timestamp integer, data blob)")
        base.execute("insert into topics values (1, '/chatter', 'std_msgs/msg/String', '- depth: 10')")
        base.executemany(
            "insert into messages values (?, 1, ?, x'00010000')", [(each, 10**9 + each) for each in range(3)]
        )
        base.commit()
    return [Path(path).read_bytes().decode("latin-1")]
