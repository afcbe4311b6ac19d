"""The arguments of `bag record`: all of those in Jazzy (rosbag2 0.26), and a few of our own."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Sequence

from bot_console.tui.cli.bags.common import existing_file, named_folder
from bot_console.tui.cli.numbers import positive

SERVICE_EVENTS = "/_service_event"
"""The suffix of the topic with a service's events."""
PRESETS = ("none", "fastwrite", "zstd_fast", "zstd_small", "resilient")
NOT_NEEDED = {
    "max_cache_size": "messages are written as they arrive",
    "compression_queue_size": "messages are compressed as they arrive",
    "compression_threads": "messages are compressed as they arrive",
    "compression_threads_priority": "messages are compressed as they arrive",
    "storage_config_file": "it configures libraries that are not used here",
    "qos_profile_overrides_path": "topics are subscribed to with the QoS that their publishers offer",
}
"""Options that have no effect here, and why that does no harm."""


def add_record_arguments(record: argparse.ArgumentParser) -> None:
    """Declare the arguments of `record`."""
    record.add_argument("topics_positional", nargs="*", metavar="TOPIC", default=[])
    record.add_argument("-o", "--output", type=named_folder, metavar="FOLDER", help="default: rosbag2_ and the time")
    record.add_argument("-s", "--storage", choices=["mcap", "sqlite3"], default="mcap")
    _add_filters(record)
    _add_discovery(record)
    record.add_argument("-f", "--serialization-format", choices=["", "cdr"], default="", help="only cdr")
    record.add_argument(
        "-b", "--max-bag-size", type=int, default=0, metavar="BYTES", help="start a new file at this size"
    )
    record.add_argument(
        "-d", "--max-bag-duration", type=int, default=0, metavar="S", help="start a new file after this time"
    )
    record.add_argument("--max-cache-size", type=int, metavar="BYTES", help="in snapshot mode: how much is kept")
    record.add_argument("--disable-keyboard-controls", action="store_true", help="space does not pause")
    record.add_argument("--start-paused", action="store_true", help="record nothing until space or ~/resume")
    record.add_argument("--use-sim-time", action="store_true", help="stamp messages with the time of /clock")
    record.add_argument("--node-name", default="rosbag2_recorder", metavar="NAME")
    record.add_argument("--custom-data", nargs="*", default=[], metavar="KEY=VALUE", help="entries for the metadata")
    record.add_argument(
        "--snapshot-mode", action="store_true", help="keep messages in memory until `bag snapshot` writes them"
    )
    levels = ["debug", "info", "warn", "error", "fatal"]
    record.add_argument("--log-level", choices=levels, default="info")
    record.add_argument("--storage-config-file", type=existing_file, metavar="FILE", help="not used")
    record.add_argument("--storage-preset-profile", choices=PRESETS, default="none", help="zstd: compressed chunks")
    record.add_argument("--compression-queue-size", type=int, metavar="N", help="not used")
    record.add_argument("--compression-threads", type=int, metavar="N", help="not used")
    record.add_argument("--compression-threads-priority", type=int, metavar="N", help="not used")
    record.add_argument("--compression-mode", choices=["none", "file", "message"], default="none")
    record.add_argument("--compression-format", choices=["", "zstd"], default="")
    record.add_argument("--duration", type=positive, metavar="S", help="stop after this many seconds")
    record.add_argument(
        "--snapshot-duration", type=positive, default=300.0, metavar="S", help="seconds to keep (default: 300)"
    )


def _add_filters(record: argparse.ArgumentParser) -> None:
    for name, what in (("topics", "TOPIC"), ("services", "SERVICE"), ("topic-types", "TYPE")):
        record.add_argument(f"--{name}", nargs="+", default=[], metavar=what)
    for name in ("topics", "topic-types", "services"):
        record.add_argument(f"--exclude-{name}", nargs="+", default=[], metavar=name[:-1].upper().replace("-", "_"))
    record.add_argument(
        "-a", "--all", action="store_true", help="all topics and services, also those that appear later"
    )
    record.add_argument("--all-topics", action="store_true", help="all topics")
    record.add_argument("--all-services", action="store_true", help="the events of all services")
    record.add_argument("-e", "--regex", type=pattern, help="topics and services whose names match")
    record.add_argument("-x", "--exclude-regex", type=pattern, help="except those whose names match")


def _add_discovery(record: argparse.ArgumentParser) -> None:
    record.add_argument(
        "--include-unpublished-topics", action="store_true", help="also topics that nobody publishes yet"
    )
    record.add_argument(
        "--include-hidden-topics", action="store_true", help="also hidden topics, with a part that begins with _"
    )
    record.add_argument("--no-discovery", action="store_true", help="only topics that exist at the start")
    record.add_argument(
        "-p", "--polling-interval", type=int, default=100, metavar="MS", help="between two searches for topics"
    )
    record.add_argument("--ignore-leaf-topics", action="store_true", help="leave out topics without a subscription")
    record.add_argument("--qos-profile-overrides-path", type=existing_file, metavar="FILE", help="not used")


def record_problem(given: argparse.Namespace) -> str:
    """What is wrong with the combination of options, in rosbag2's words if it checks that; empty if nothing is."""
    everything = given.all or given.all_topics or given.topic_types or given.regex
    named = given.topics or given.topics_positional or given.services
    if not (everything or given.all_services or named):
        return "Name topics, or use --all, --all-topics, --all-services, --services, --topic-types or --regex"
    needed = "--all, --all-topics, --topic-types"
    if given.exclude_regex and not (everything or given.all_services):
        return f"--exclude-regex argument requires either {needed}, --all-services or --regex"
    if given.exclude_topics and not everything:
        return f"--exclude-topics argument requires either {needed} or --regex"
    if given.exclude_topic_types and not everything:
        return f"--exclude-topic-types argument requires either {needed} or --regex"
    if given.exclude_services and not (given.all or given.all_services or given.regex):
        return "--exclude-services argument requires either --all, --all-services or --regex"
    if given.use_sim_time and given.no_discovery:
        return "--use-sim-time and --no-discovery exclude each other: /clock has to be found"
    if given.compression_format and given.compression_mode == "none":
        return "--compression-format needs a --compression-mode: file or message"
    for each in given.custom_data:
        if "=" not in each:
            return f"--custom-data takes KEY=VALUE, not '{each}'"
    return ""


def wanted_topics(
    given: argparse.Namespace, published: Callable[[str], bool], subscribed: Callable[[str], bool]
) -> Callable[[str, Sequence[str]], bool]:
    """Return a function that decides whether to record a topic, given its name and types.

    `published` and `subscribed` return whether a topic has publishers and subscriptions.
    """
    named = {f"/{each.lstrip('/')}" for each in (*given.topics, *given.topics_positional)}
    named |= {f"/{each.strip('/')}{SERVICE_EVENTS}" for each in given.services}
    excluded = {f"/{each.lstrip('/')}" for each in given.exclude_topics}
    excluded |= {f"/{each.strip('/')}{SERVICE_EVENTS}" for each in given.exclude_services}

    def chosen(topic: str, types: Sequence[str]) -> bool:
        events = topic.endswith(SERVICE_EVENTS)
        if topic in excluded or (not events and any(each in given.exclude_topic_types for each in types)):
            return False
        if given.exclude_regex is not None and given.exclude_regex.search(topic):
            return False
        if given.all or (given.all_services if events else given.all_topics):
            return True
        if given.regex is not None and given.regex.search(topic):
            return True
        return any(each in given.topic_types for each in types)

    def wanted(topic: str, types: Sequence[str]) -> bool:
        if topic not in named:
            if not chosen(topic, types):
                return False
            hidden = any(part.startswith("_") for part in topic.removesuffix(SERVICE_EVENTS).split("/"))
            if hidden and not given.include_hidden_topics:
                return False
        if not given.include_unpublished_topics and not published(topic):
            return False
        return not given.ignore_leaf_topics or subscribed(topic)

    return wanted


def pattern(text: str) -> re.Pattern[str] | None:
    """Argument type: a regular expression; None for an empty text."""
    try:
        return re.compile(text) if text else None
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not a regular expression: {error}") from None
