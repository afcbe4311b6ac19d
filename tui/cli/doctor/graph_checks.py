"""Checks of the graph through rclpy's public API, on any middleware: blocked messages, types, the base's time-out."""

from __future__ import annotations

from collections.abc import Callable

import rclpy
from bot_console.runtime.rosidl import type_hash
from bot_console.tui.cli.doctor.command_timeout import base_finding
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.cli.doctor.spinning import spin_for
from bot_console.tui.console.graph.pairs import hash_of, unheard
from bot_console.tui.console.own_context import WITHOUT_LOG_FILE
from bot_console.tui.console.topics.interfaces import message_named
from rclpy.node import Node

DISCOVERY_S = 1.5
"""Seconds for discovery."""
DDS_DISCOVERY_S = 4.0
"""Seconds for discovery over a network: Fast DDS repeats announcements that were lost every three seconds."""


def node_findings(
    can_learn: Callable[[str], bool] = lambda type_name: False, alone_hint: str = "", settle: float = DISCOVERY_S
) -> list[DoctorFinding]:
    """Run the checks from a node on this process's middleware, after `settle` seconds of discovery.

    With `alone_hint` the nodes are counted, and the hint is given if there are no others.
    """
    rclpy.init(args=WITHOUT_LOG_FILE)
    node = rclpy.create_node("_bot_console_doctor", enable_rosout=False, start_parameter_services=False)
    try:
        spin_for(node, settle)
        counted = [others_finding(node, alone_hint)] if alone_hint else []
        return [*counted, *pair_findings(node), *type_findings(node, can_learn), base_finding(node)]
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def others_finding(node: Node, alone_hint: str) -> DoctorFinding:
    """The number of other nodes that were discovered, not counting hidden ones such as those of consoles."""
    count = sum(not name.startswith("_") for name in node.get_node_names())
    if not count:
        return DoctorFinding(Level.WARN, "graph", "no other node was found", alone_hint)
    return DoctorFinding(Level.OK, "graph", f"{count} other node{'' if count == 1 else 's'}")


def pair_findings(node: Node) -> list[DoctorFinding]:
    """A finding for each pair of publisher and subscription between which no messages pass."""
    found: list[DoctorFinding] = []
    for topic, _ in sorted(node.get_topic_names_and_types()):
        publishers, subscriptions = (
            node.get_publishers_info_by_topic(topic),
            node.get_subscriptions_info_by_topic(topic),
        )
        for text in unheard(topic, publishers, subscriptions):
            message, _, hint = text.rpartition("; " if "; " in text else ": ")
            found.append(DoctorFinding(Level.WARN, "topics", message, hint))
    return found or [
        DoctorFinding(Level.OK, "topics", "types, hashes and QoS of all publishers and subscriptions match")
    ]


def type_findings(node: Node, can_learn: Callable[[str], bool] = lambda type_name: False) -> list[DoctorFinding]:
    """Types that are unknown here or defined differently.

    The definitions of those that `can_learn` accepts are requested from their nodes when they are used.
    """
    unknown: set[str] = set()
    learned: set[str] = set()
    other: set[str] = set()
    for topic, types in node.get_topic_names_and_types():
        for kind in types:
            ours = own_hash(kind)
            ends = (*node.get_publishers_info_by_topic(topic), *node.get_subscriptions_info_by_topic(topic))
            theirs = {hash_of(each) for each in ends if each.topic_type == kind} - {""}
            if ours is None:
                (learned if can_learn(kind) else unknown).add(kind)
            elif ours and theirs - {ours}:
                other.add(kind)
    found: list[DoctorFinding] = []
    if other:
        hint = "install the same version of the interfaces on both sides"
        found.append(DoctorFinding(Level.WARN, "types", f"defined differently here: {', '.join(sorted(other))}", hint))
    if unknown:
        hint = "put their package in the workspace (--workspace DIR) or source it, to see their fields"
        found.append(DoctorFinding(Level.NOTE, "types", f"unknown here: {', '.join(sorted(unknown))}", hint))
    if learned:
        text = f"learned from their nodes on use: {', '.join(sorted(learned))}"
        found.append(DoctorFinding(Level.OK, "types", text))
    return found or [DoctorFinding(Level.OK, "types", "all are known here")]


def own_hash(type_name: str) -> str | None:
    """The hash of a type as defined here; None if the type is unknown, empty if no hash can be computed."""
    try:
        kind = message_named(type_name)
    except (ImportError, AttributeError):
        return None
    try:
        return type_hash.text(kind)
    except (AttributeError, TypeError, KeyError):  # A class of a real ROS 2, which checks that itself.
        return ""
