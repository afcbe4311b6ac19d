"""Parsers of recordings: each function feeds a text to one of them, in place of bytes if the file is not text."""

from __future__ import annotations

import argparse
import io
import shutil
import sqlite3
from collections.abc import Callable, Sequence
from contextlib import closing, redirect_stdout, suppress
from pathlib import Path

from files import FOLDER, file


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


def metadata(text: str) -> None:
    from bot_console.tui.console.bags.damage import NoBag
    from bot_console.tui.console.bags.metadata import qos_profiles
    from bot_console.tui.console.bags.reader import _files

    folder = file(text, "metadata.yaml").parent
    with suppress(NoBag):
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
