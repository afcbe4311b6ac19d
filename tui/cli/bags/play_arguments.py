"""The arguments of `bag play` and `bag burst`: all of those in Jazzy (rosbag2 0.26), and some of newer releases."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from pathlib import Path

from bot_console.tui.cli.bags.common import existing_file, named_folder
from bot_console.tui.cli.bags.record_arguments import SERVICE_EVENTS, pattern
from bot_console.tui.cli.numbers import positive, seconds

NOT_NEEDED = {
    "read_ahead_queue_size": "messages are read when they are due",
    "storage_config_file": "it configures libraries that are not used here",
    "storage": "the storage is recognised by the file",
    "disable_loan_message": "no messages are loaned here",
    "progress_bar_update_rate": "the line of progress follows the terminal",
    "progress_bar_separation_lines": "the line of progress follows the terminal",
}
"""Options that have no effect here, and why that does no harm."""


def add_play_arguments(play: argparse.ArgumentParser) -> None:
    """Declare the arguments of `play`."""
    _add_reading(play)
    play.add_argument("-r", "--rate", type=positive, default=1.0, help="speed; 2 plays twice as fast")
    play.add_argument("-l", "--loop", action="store_true", help="start again at the end")
    play.add_argument("-d", "--delay", type=seconds, default=0.0, metavar="S", help="wait before the start")
    play.add_argument("-p", "--start-paused", action="store_true", help="begin when space is pressed")
    play.add_argument("--disable-keyboard-controls", action="store_true")
    clock = play.add_mutually_exclusive_group()
    clock.add_argument("--clock", nargs="?", type=positive, const=40.0, default=0.0, help="publish /clock (40 Hz)")
    clock.add_argument("--clock-topics", nargs="+", default=[], metavar="TOPIC", help="/clock before each of these")
    clock.add_argument("--clock-topics-all", action="store_true", help="/clock before each message")
    play.add_argument("--playback-duration", type=float, default=-1.0, metavar="S", help="stop after this many seconds")
    until = play.add_mutually_exclusive_group()
    until.add_argument("--playback-until-sec", type=float, default=-1.0, metavar="TIME", help="s since the epoch")
    until.add_argument("--playback-until-nsec", type=int, default=-1, metavar="TIME", help="ns since the epoch")
    play.add_argument("--wait-for-all-acked", type=int, metavar="MS", help="at the end; 0 waits forever")
    play.add_argument("--disable-loan-message", action="store_true", help="not used")
    play.add_argument("--publish-service-requests", action="store_true", help="not supported here")
    play.add_argument("--service-requests-source", choices=["service_introspection", "client_introspection"])
    play.add_argument("--progress-bar-update-rate", type=int, metavar="HZ", help="not used")
    play.add_argument("--progress-bar-separation-lines", type=int, metavar="N", help="not used")


ON_MACHINE = "play into the ROS 2 of this machine, as attach --ros reaches it"


def add_burst_arguments(burst: argparse.ArgumentParser) -> None:
    """Declare the arguments of `burst`."""
    _add_reading(burst)
    burst.add_argument("-n", "--num-messages", type=int, default=0, metavar="N", help="0: all")


def _add_reading(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("bag", type=named_folder, nargs="?")
    parser.add_argument("--ros", action="store_true", help=ON_MACHINE)
    parser.add_argument(
        "-i", "--input", nargs="+", action="append", default=[], metavar=("BAG", "STORAGE"),
        help="another bag to play at the same time",
    )  # fmt: skip
    parser.add_argument("-s", "--storage", choices=["mcap", "sqlite3"], help="not used: detected from the file")
    parser.add_argument("--read-ahead-queue-size", type=int, metavar="N", help="not used")
    parser.add_argument(
        "--topics", nargs="+", metavar="TOPIC", help="only these topics; default: all that do not control a robot"
    )
    parser.add_argument("--services", nargs="+", default=[], metavar="SERVICE", help="the events of these services")
    parser.add_argument("-e", "--regex", type=pattern, help="only topics and services whose names match")
    parser.add_argument("-x", "--exclude-regex", type=pattern, help="except those whose names match")
    parser.add_argument("--exclude-topics", nargs="+", default=[], metavar="TOPIC")
    parser.add_argument("--exclude-services", nargs="+", default=[], metavar="SERVICE")
    parser.add_argument("--qos-profile-overrides-path", type=existing_file, metavar="FILE", help="YAML, by topic")
    parser.add_argument("--remap", "-m", nargs="+", default=[], metavar="OLD:=NEW", help="rename topics")
    parser.add_argument("--storage-config-file", type=existing_file, metavar="FILE", help="not used")
    parser.add_argument("--start-offset", type=seconds, default=0.0, metavar="S", help="skip the first seconds")
    levels = ["debug", "info", "warn", "error", "fatal"]
    parser.add_argument("--log-level", choices=levels, default="info")


def play_problem(given: argparse.Namespace) -> str:
    """What is wrong with the combination of options; empty if nothing is."""
    if given.bag is None and not given.input:
        return "Name a bag, or several with --input"
    if wrong := input_problem(given.input):
        return wrong
    for each in given.remap:
        if ":=" not in each:
            return f"--remap takes OLD:=NEW, not '{each}'"
    if getattr(given, "publish_service_requests", False):
        return "--publish-service-requests cannot be done here: the recorded events of services are published instead"
    return ""


def input_problem(inputs: list[list[str]]) -> str:
    """What is wrong with the values of `--input`; empty if nothing is."""
    for each in inputs:
        if len(each) > 2 or (len(each) == 2 and each[1] not in ("mcap", "sqlite3")):
            return (
                f"--input takes a bag and perhaps its storage, mcap or sqlite3, not '{' '.join(each)}'; "
                "for several bags repeat --input"
            )
    return ""


def bag_paths(given: argparse.Namespace) -> list[Path]:
    """The bags that were named."""
    return [*([given.bag] if given.bag is not None else []), *(Path(each[0]) for each in given.input)]


def chosen_topics(given: argparse.Namespace) -> tuple[list[str] | None, Callable[[str], bool]]:
    """The topics that were named (None if none were), and a function that applies the other options to a topic."""
    named: list[str] = [*(given.topics or []), *(f"{each.rstrip('/')}{SERVICE_EVENTS}" for each in given.services)]
    excluded = {f"/{each.lstrip('/')}" for each in given.exclude_topics}
    excluded |= {f"/{each.strip('/')}{SERVICE_EVENTS}" for each in given.exclude_services}
    regex: re.Pattern[str] | None = given.regex
    exclude: re.Pattern[str] | None = given.exclude_regex

    def chosen(topic: str) -> bool:
        if topic in excluded or (exclude is not None and exclude.search(topic)):
            return False
        return bool(named) or regex is None or regex.search(topic) is not None

    return named or None, chosen


def span_problem(given: argparse.Namespace, begin: int, last: int) -> str:
    """Why the options leave nothing to play of a bag (ns since the epoch); empty if they leave something."""
    duration = (last - begin) / 1e9
    if given.start_offset > duration:
        return f"--start-offset {given.start_offset:g}: the bag ends after {duration:.1f} s"
    end = end_time(given, begin)
    if end is not None and end < begin:
        return (
            f"The end that the options set is before the first message, which is at {begin / 1e9:.3f} s since the epoch"
        )
    return ""


def end_time(given: argparse.Namespace, begin: int) -> int | None:
    """The time (ns since the epoch) at which to stop: the latest one given by an option; None if none is."""
    ends: list[int] = []
    if given.playback_duration >= 0:
        ends.append(begin + int((given.start_offset + given.playback_duration) * 1e9))
    if given.playback_until_sec >= 0:
        ends.append(int(given.playback_until_sec * 1e9))
    if given.playback_until_nsec >= 0:
        ends.append(given.playback_until_nsec)
    return max(ends, default=None)
