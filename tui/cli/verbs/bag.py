"""`bot-console bag record|play|info|open|snapshot|burst|convert|reindex|list`, like `ros2 bag`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from functools import partial

from bot_console.runtime.importer import install
from bot_console.tui.cli.arguments import parse
from bot_console.tui.cli.bags import convert, info, play, record
from bot_console.tui.cli.bags.common import generic_types, join_domain, named_folder
from bot_console.tui.cli.bags.play_arguments import ON_MACHINE, add_burst_arguments, add_play_arguments
from bot_console.tui.cli.bags.record_arguments import add_record_arguments
from bot_console.tui.console.bags.damage import BagError
from bot_console.tui.console.bags.missing_packages import MissingPackageError
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.session.machine.console_needs import provide_missing
from bot_console.tui.session.machine.machine_ros import find_machine_ros, how_to_install
from bot_console.tui.text.sanitize import sanitize


def run(words: Sequence[str]) -> int:
    """Run a `bag` command line; 0 done, 1 failed, 2 wrong usage."""
    given = parser().parse_args(words)
    if unusable := _choose_rclpy(machine=getattr(given, "ros", False)):
        print(unusable, file=sys.stderr)
        return 1
    try:
        return given.run(given)
    except (MissingPackageError, BagError, NotSaved) as error:
        print(sanitize(str(error)), file=sys.stderr)
        return 1
    except KeyboardInterrupt:  # before there was a node that handles it
        return 130


def _choose_rclpy(*, machine: bool) -> str:
    """Make `import rclpy` find the machine's rclpy or ours; returns why the machine's cannot be used, or empty."""
    if not machine:
        install()
        return ""
    found = find_machine_ros()
    if found is None:
        return (
            "--ros needs a ROS 2 on this machine: source it, or install bot-console with an extra such as [ros-jazzy]"
        )
    if not found.usable:
        return how_to_install(found)
    provide_missing()
    return ""


def parser() -> argparse.ArgumentParser:
    """Return the parser of all verbs."""
    made = argparse.ArgumentParser("bot-console bag", description="Record topics, and play recordings.")
    verbs = made.add_subparsers(required=True, metavar="VERB")

    def add(name: str, run: Callable[[argparse.Namespace], int], about: str) -> argparse.ArgumentParser:
        verb = verbs.add_parser(name, help=about, description=f"{about[0].upper()}{about[1:]}.")
        verb.set_defaults(run=run)
        return verb

    def reads_one(verb: argparse.ArgumentParser) -> argparse.ArgumentParser:
        verb.add_argument("bag", type=named_folder)
        verb.add_argument("-s", "--storage", choices=["mcap", "sqlite3"], help="not used: detected from the file")
        return verb

    add_record_arguments(add("record", record.record, "record topics to a bag"))
    add_play_arguments(add("play", play.play, "publish the messages of a bag"))
    add_burst_arguments(add("burst", play.burst, "publish the messages of a bag as fast as possible"))
    shown = reads_one(add("info", info.info, "show the contents of a bag"))
    shown.add_argument("-t", "--topic-name", action="store_true", help="only the names of topics")
    shown.add_argument("-v", "--verbose", action="store_true", help="requests and responses of services")
    opened = add("open", _open, "open a bag in the console, and move through its time")
    opened.add_argument("bag", type=named_folder)
    opened.add_argument("--play", action="store_true", help="play it at once, into the ROS domain")
    opened.add_argument("--ros", action="store_true", help=ON_MACHINE)
    add("snapshot", record.snapshot, "make a recorder in snapshot mode write its messages")
    convert.add_convert_arguments(add("convert", convert.convert, "rewrite bags with other settings"))
    reads_one(add("reindex", convert.reindex, "rewrite the metadata of a bag"))
    listed = add("list", convert.list_plugins, "print the names of plug-ins")
    listed.add_argument("plugin_type", choices=list(convert.PLUGINS))
    listed.add_argument("--verbose", action="store_true")
    return made


def _open(given: argparse.Namespace) -> int:
    from bot_console.tui.bag_app import BagApp
    from bot_console.tui.cli.appearance import appearance_of
    from bot_console.tui.cli.terminal_check import terminal_problem
    from bot_console.tui.console.bags.contents import Contents
    from bot_console.tui.console.bags.opened_bag import OpenedBag
    from bot_console.tui.console.bags.playing.bag_playback import BagPlayback

    bag = Bag(given.bag)
    play.report_repaired(bag)
    print(f"Reading {bag.metadata.count} messages ...", file=sys.stderr)
    contents = Contents(bag)
    if problem := terminal_problem("`bag open` needs a terminal; without one, `bag info` and `bag play` read the bag"):
        print(problem, file=sys.stderr)
        return 1
    console = OpenedBag(contents, given.bag.resolve().name)
    options = parse([])
    notes = [f"{each} is not shown: the bag is too large" for each in contents.left_out]
    notes += [contents.damage] if contents.damage else []
    playback = BagPlayback(bag, partial(join_domain, machine=given.ros), generic_types(machine=given.ros))
    try:
        app = BagApp(
            console, opening=options.opening._replace(notes=tuple(notes)), appearance=appearance_of(options),
            playback=playback, plays=given.play,
        )  # fmt: skip
        app.time_cursor.follow(console.topics)
        app.run()
    finally:
        playback.close()
        console.close()
    return 0
