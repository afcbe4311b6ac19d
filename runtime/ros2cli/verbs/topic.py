"""`ros2 topic`: list, info, type and find; the verbs that send or receive messages have files of their own."""

from __future__ import annotations

import argparse
from functools import partial

from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import DirectNode, add_strategy_arguments
from ros2cli.names_and_types import (
    NamesAndTypes,
    add_count_argument,
    add_hidden_argument,
    print_found,
    print_names,
    print_types,
    repeat_hidden_argument,
    visible_rows,
)
from ros2cli.verbs import topic_echo, topic_pub, topic_rate

_hidden_as_well = partial(repeat_hidden_argument, "topics")


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the topic type")
    add_count_argument("topics", parser)
    _hidden_as_well(parser)
    parser.add_argument("-v", "--verbose", action="store_true", help="List full details about each topic")


def _list(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        rows = visible_rows(node.get_topic_names_and_types(), arguments.include_hidden_topics)
        counts = {name: (node.count_publishers(name), node.count_subscribers(name)) for name, _ in rows}
    if arguments.count_topics:
        print(len(rows))
    elif arguments.verbose and rows:
        _print_sides(rows, counts)
    else:
        print_names(rows, arguments.show_types)
    return None


def _print_sides(rows: NamesAndTypes, counts: dict[str, tuple[int, int]]) -> None:
    for side, (title, word) in enumerate((("Published topics:", "publisher"), ("Subscribed topics:", "subscriber"))):
        print(title)
        for name, types in rows:
            count = counts[name][side]
            if count:
                print(f" * {name} [{', '.join(types)}] {count} {word}{'s' if count > 1 else ''}")
        print("")


def _info_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "--verbose",
        "-v",
        action="store_true",
        help="Prints detailed information like the node name, node namespace, topic type, topic type hash, GUID, "
        "and QoS Profile of the publishers and subscribers to this topic",
    )


def _info(arguments: argparse.Namespace) -> Result:
    name = arguments.topic_name
    with DirectNode(arguments) as node:
        types = dict(node.get_topic_names_and_types()).get(name)
        if types is None:
            return f"Unknown topic '{name}'"
        print(f"Type: {types[0] if len(types) == 1 else types}", end="\n\n" if arguments.verbose else "\n")
        for title, count, endpoints in (
            ("Publisher count:", node.count_publishers(name), node.get_publishers_info_by_topic),
            ("Subscription count:", node.count_subscribers(name), node.get_subscriptions_info_by_topic),
        ):
            print(f"{title} {count}", end="\n\n" if arguments.verbose else "\n")
            if arguments.verbose:
                for each in endpoints(name):
                    print(each, end="\n\n")
    return None


def _type_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")
    _hidden_as_well(parser)


def _type(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        rows = visible_rows(node.get_topic_names_and_types(), arguments.include_hidden_topics)
    return print_types(rows, arguments.topic_name)


def _find_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("topic_type", help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')")
    add_count_argument("topics", parser)
    _hidden_as_well(parser)


def _find(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        rows = visible_rows(node.get_topic_names_and_types(), arguments.include_hidden_topics)
    return print_found(rows, arguments.topic_type, arguments.count_topics)


COMMAND = Command(
    "topic",
    "Various topic related sub-commands",
    (
        Verb("bw", "Display bandwidth used by topic", topic_rate.bandwidth, topic_rate.bandwidth_arguments),
        Verb("delay", "Display delay of topic from timestamp in header", topic_rate.delay, topic_rate.delay_arguments),
        Verb("echo", "Output messages from a topic", topic_echo.echo, topic_echo.arguments),
        Verb("find", "Output a list of available topics of a given type", _find, _find_arguments),
        Verb("hz", "Print the average publishing rate to screen", topic_rate.rate, topic_rate.rate_arguments),
        Verb("info", "Print information about a topic", _info, _info_arguments),
        Verb("list", "Output a list of available topics", _list, _list_arguments),
        Verb("pub", "Publish a message to a topic", topic_pub.publish, topic_pub.arguments),
        Verb("type", "Print a topic's type", _type, _type_arguments),
    ),
    partial(add_hidden_argument, "topics"),
)
