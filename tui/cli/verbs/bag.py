"""`bot-console bag record|play|info|open|snapshot`, like `ros2 bag`."""

from __future__ import annotations

import argparse
import re
import sys
import threading
import time
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bot_console.runtime.importer import install
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.format import sanitize
from bot_console.tui.session.embedded.reaching import reach_system

if TYPE_CHECKING:
    from bot_console.tui.console.bags.recorder import Ring
    from rclpy.node import Node

RECORDER = "rosbag2_recorder"
SNAPSHOT = f"/{RECORDER}/snapshot"
MAX_SNAPSHOT_BYTES = 512 * 1024 * 1024
"""The largest size of a snapshot."""
READY = 0.5
"""Seconds that a player waits for subscribers before the first message."""


def run(words: Sequence[str]) -> int:
    """Run a `bag` command line; 0 done, 1 failed, 2 wrong usage."""
    install()
    from bot_console.tui.console.bags.damage import NoBag
    from bot_console.tui.console.bags.missing_packages import Missing

    given = _parser().parse_args(words)
    try:
        return given.run(given)
    except (Missing, NoBag, NotSaved, re.error) as error:
        print(sanitize(str(error)), file=sys.stderr)
        return 1
    except KeyboardInterrupt:  # Before there was a node that ends in order.
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("bot-console bag", description="Record topics, and play recordings.")
    verbs = parser.add_subparsers(required=True, metavar="VERB")
    record = verbs.add_parser("record", help="record topics to an MCAP bag")
    record.set_defaults(run=_record)
    record.add_argument("topics", nargs="*", metavar="TOPIC")
    record.add_argument("-a", "--all", action="store_true", help="all topics, including those that appear later")
    record.add_argument("-e", "--regex", default="", help="topics whose names match")
    record.add_argument("-x", "--exclude-regex", default="", help="except topics whose names match")
    record.add_argument("-o", "--output", type=_named, metavar="FOLDER", help="default: rosbag2_ and the time")
    record.add_argument("--duration", type=float, metavar="S", help="stop after so many seconds")
    record.add_argument(
        "--snapshot-mode", action="store_true", help="keep messages in memory until `bag snapshot` writes them"
    )
    record.add_argument("--snapshot-duration", type=float, default=300.0, metavar="S", help="seconds to keep (300)")
    play = verbs.add_parser("play", help="publish the messages of a bag")
    play.set_defaults(run=_play)
    play.add_argument("bag", type=_named)
    play.add_argument("-r", "--rate", type=_positive, default=1.0, help="speed; 2 plays twice as fast")
    play.add_argument("-l", "--loop", action="store_true", help="start again at the end")
    play.add_argument(
        "--topics", nargs="+", metavar="TOPIC", help="only these topics; default: all that do not control a robot"
    )
    play.add_argument("--remap", "-m", nargs="+", default=[], metavar="OLD:=NEW", help="rename topics")
    play.add_argument("--start-offset", type=float, default=0.0, metavar="S", help="skip the first seconds")
    play.add_argument("--clock", nargs="?", type=_positive, const=40.0, default=0.0, help="publish /clock (40 Hz)")
    info = verbs.add_parser("info", help="show the contents of a bag")
    info.set_defaults(run=_info)
    info.add_argument("bag", type=_named)
    opened = verbs.add_parser("open", help="open a bag in the console, and move through its time")
    opened.set_defaults(run=_open)
    opened.add_argument("bag", type=_named)
    snapshot = verbs.add_parser("snapshot", help="make a recorder in snapshot mode write its messages")
    snapshot.set_defaults(run=_snapshot)
    return parser


def _named(text: str) -> Path:
    if not text:
        raise argparse.ArgumentTypeError("the name of the bag is empty")
    return Path(text)


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be positive, not {text}")
    return value


def _wanted(given: argparse.Namespace) -> Callable[[str], bool]:
    named = {f"/{each.lstrip('/')}" for each in given.topics}
    regex, excluded = (re.compile(each) if each else None for each in (given.regex, given.exclude_regex))

    def wanted(topic: str) -> bool:
        if excluded is not None and excluded.search(topic):
            return False
        return given.all or topic in named or (regex is not None and regex.search(topic) is not None)

    return wanted


def _record(given: argparse.Namespace) -> int:
    from bot_console.tui.console.bags.recorder import PACE_S, Recorder, Ring, not_recorded
    from bot_console.tui.console.bags.writer import BagWriter

    if not (given.all or given.topics or given.regex):
        print("Name topics, or use --regex or --all", file=sys.stderr)
        return 2
    wanted = _wanted(given)
    folder = given.output or _new_folder()
    node = _node(RECORDER)
    if node is None:
        return 1
    sink = Ring(given.snapshot_duration, MAX_SNAPSHOT_BYTES) if given.snapshot_mode else BagWriter(folder)
    recorder = Recorder(node, sink, wanted, _Types())
    logger = node.get_logger()
    reported: set[str] = set()

    def report() -> None:
        for name in recorder.subscribed.keys() - reported:
            logger.info(f"Subscribed to topic '{name}'")
        for name in recorder.unknown.keys() - reported:
            logger.warning(f"Topic '{name}' is not recorded: {recorder.unknown[name]}")
        reported.update(recorder.subscribed, recorder.unknown)

    import rclpy

    try:
        control = rclpy.create_node(f"_{RECORDER}_control", start_parameter_services=False)
        control.create_timer(PACE_S, recorder.turn)
        control.create_timer(0.5, report)
        if isinstance(sink, Ring):
            _offer_snapshots(control, sink, given.output)
            logger.info(f"Keeping the last {given.snapshot_duration:g} s; `bot-console bag snapshot` writes them")
        else:
            logger.info(f"Recording to {folder}")
        _spin(control, given.duration)
    finally:  # Also if a Ctrl-C came before there was anything to spin.
        recorder.close()
        if isinstance(sink, BagWriter):
            sink.close()
    if isinstance(sink, BagWriter):
        print(f"{sink.metadata.count} messages of {len(sink.metadata.topics)} topics in {folder}", file=sys.stderr)
    named = (f"/{each.lstrip('/')}" for each in given.topics)
    absent = {each: "nobody has published it" for each in named if each not in recorder.subscribed}
    if missing := not_recorded({**absent, **recorder.unknown}):
        print(sanitize(missing), file=sys.stderr)
    return 0


class _Types:
    """Returns the class of a message type; one that is unknown here is requested once from the nodes that use it.

    Raises `ImportError`, `AttributeError` or `ValueError` if there is none.
    """

    def __init__(self) -> None:
        import rclpy

        self._asked: set[str] = set()
        self._node = rclpy.create_node(f"_{RECORDER}_types", start_parameter_services=False)

    def __call__(self, type_name: str) -> Any:
        from bot_console.tui.console.bags.definitions import class_of

        try:
            return class_of(type_name)
        except (ImportError, AttributeError, ValueError):
            if type_name in self._asked:
                raise
        from ros2cli.type_discovery import learned

        self._asked.add(type_name)
        if why := learned(type_name, self._node):
            raise ImportError(why)
        return class_of(type_name)


def _offer_snapshots(node: Node, ring: Ring, output: Path | None) -> None:
    from bot_console.tui.console.bags.writer import BagWriter
    from std_srvs.srv import Trigger

    def write(_: Any, answer: Any) -> Any:
        folder = _new_folder(output)
        try:
            writer = BagWriter(folder)
            count = ring.pour(writer)
            writer.close()
        except NotSaved as error:
            answer.success, answer.message = False, str(error)
            return answer
        answer.success, answer.message = True, f"{count} messages in {folder.resolve()}"
        return answer

    node.create_service(Trigger, SNAPSHOT, write)


def _snapshot(given: argparse.Namespace) -> int:
    import rclpy
    from std_srvs.srv import Trigger

    node = _node("_snapshot")
    if node is None:
        return 1
    client = node.create_client(Trigger, SNAPSHOT)
    if not client.wait_for_service(timeout_sec=1.0):
        print("No recorder in snapshot mode runs: `bot-console bag record --all --snapshot-mode`", file=sys.stderr)
        return 1
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=30.0)
    answer = future.result()
    if answer is None:
        print("The recorder did not answer within 30 s", file=sys.stderr)
        return 1
    print(sanitize(answer.message), file=sys.stdout if answer.success else sys.stderr)
    return 0 if answer.success else 1


def _play(given: argparse.Namespace) -> int:
    from bot_console.tui.console.bags.damage import NoBag
    from bot_console.tui.console.bags.definitions import class_of
    from bot_console.tui.console.bags.playing.control_topics import left_out_warning
    from bot_console.tui.console.bags.playing.player import Player, Playing
    from bot_console.tui.console.bags.reader import Bag

    bag = Bag(given.bag)
    _report_repaired(bag)
    remaps = dict(each.split(":=", 1) for each in given.remap if ":=" in each)
    node = _node("rosbag2_player")
    if node is None:
        return 1
    how = Playing(given.rate, given.start_offset, given.loop, given.topics, remaps, given.clock)
    player = Player(node, bag, how, class_of)
    for name, why in player.unknown.items():
        node.get_logger().warning(f"Topic '{name}' is not played: {why}")
    if player.left_out:
        print(sanitize(f"warning: {left_out_warning(player.left_out)}"), file=sys.stderr)
    stopped = threading.Event()
    damage: list[str] = []

    def play() -> None:
        try:
            if not stopped.wait(READY):
                player.run(stopped)
        except NoBag as error:
            damage.append(str(error))
        finally:
            stopped.set()

    thread = threading.Thread(target=play, name="player", daemon=True)
    thread.start()
    _spin(node, None, stopped)
    stopped.set()
    thread.join(5.0)
    print(f"{player.published} messages published", file=sys.stderr)
    if damage:
        print(sanitize(damage[0]), file=sys.stderr)
    return len(damage)


def _info(given: argparse.Namespace) -> int:
    from bot_console.tui.console.bags.reader import Bag

    bag = Bag(given.bag)
    _report_repaired(bag)
    about = bag.metadata
    size = sum(each.stat().st_size for each in bag.files)
    rows = [
        ("Files", ", ".join(each.name for each in bag.files)),
        ("Bag size", _size(size)),
        ("Storage id", bag.storage),
        ("Duration", f"{(about.end - about.begin) / 1e9:.9f}s"),
        ("Start", _time(about.begin)),
        ("End", _time(about.end)),
        ("Messages", str(about.count)),
    ]
    lines = [f"{name + ':':<19}{value}" for name, value in rows]
    topics = [
        f"Topic: {each.name} | Type: {each.type} | Count: {each.count} | Serialization Format: {each.encoding}"
        for each in sorted(about.topics.values(), key=lambda topic: topic.name)
    ]
    lines += [f"{'Topic information:' if not at else '':<19}{topic}" for at, topic in enumerate(topics)]
    print("\n".join(sanitize(line) for line in lines))
    return 0


def _open(given: argparse.Namespace) -> int:
    from bot_console.tui.app import BotConsoleApp
    from bot_console.tui.cli.appearance import appearance_of
    from bot_console.tui.cli.arguments import parse
    from bot_console.tui.console.bags.contents import Contents
    from bot_console.tui.console.bags.opened_bag import OpenedBag
    from bot_console.tui.console.bags.reader import Bag

    bag = Bag(given.bag)
    _report_repaired(bag)
    print(f"Reading {bag.metadata.count} messages ...", file=sys.stderr)
    contents = Contents(bag)
    console = OpenedBag(contents, given.bag.resolve().name)
    options = parse([])
    notes = [f"{each} is not shown: the bag is too large" for each in contents.left_out]
    notes += [contents.damage] if contents.damage else []
    try:
        app = BotConsoleApp(
            console, opening=options.opening._replace(notes=tuple(notes)), appearance=appearance_of(options)
        )
        app.time_cursor.follow(console.topics)
        app.run()
    finally:
        console.close()
    return 0


def _report_repaired(bag: Any) -> None:
    for each in bag.repaired:
        print(sanitize(each), file=sys.stderr)


def _size(count: int) -> str:
    value, unit = float(count), "B"
    for unit in ("B", "KiB", "MiB", "GiB"):
        if value < 1024 or unit == "GiB":
            break
        value /= 1024
    return f"{value:.1f} {unit}" if unit != "B" else f"{count} B"


def _time(stamp: int) -> str:
    when = datetime.fromtimestamp(stamp // 10**9)
    return f"{when:%b %d %Y %H:%M:%S}.{stamp % 10**9:09} ({stamp // 10**9}.{stamp % 10**9:09})"


def _new_folder(near: Path | None = None) -> Path:
    base = near or Path(f"rosbag2_{time.strftime('%Y_%m_%d-%H_%M_%S')}")
    found, number = base, 0
    while found.exists():
        number += 1
        found = base.with_name(f"{base.name}_{number}")
    return found


def _node(name: str) -> Any:
    """A node in the domain, or behind the robot's router; None, after printing why, if neither can be reached."""
    import rclpy

    unreachable = reach_system()
    if unreachable:
        print(unreachable, file=sys.stderr)
        return None
    rclpy.init(args=[])
    return rclpy.create_node(name, start_parameter_services=False)


def _spin(node: Node, duration: float | None, stopped: threading.Event | None = None) -> None:
    """Spin until the time is up, or until it is stopped or the program is asked to end."""
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

    end = None if duration is None else time.monotonic() + duration
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not (stopped is not None and stopped.is_set()) and (end is None or time.monotonic() < end):
            executor.spin_once(timeout_sec=0.1)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
