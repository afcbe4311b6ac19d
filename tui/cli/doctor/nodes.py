"""Checks of the graph through rclpy's public API, on every middleware: blocked messages, and what stops the robot."""

from __future__ import annotations

import importlib
import re
import time
from collections.abc import Callable
from typing import Any

import rclpy
from bot_console.runtime.rosidl import type_hash
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.cli.doctor.locks import ask_locks, find_locks, lock_finding
from bot_console.tui.console.graph.full_name import node_name_of
from bot_console.tui.console.graph.pairs import hash_of, unheard
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

TWISTS = ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")
TIMEOUT = re.compile(r"(cmd|command|vel|twist|input|watchdog).*time_?out|time_?out.*(cmd|command|vel)|watchdog", re.I)
"""Names of the parameters that stop a base or controller when commands cease."""
DISCOVERY_S, TIMEOUT_S = 1.5, 3.0
"""Seconds for discovery, and for a node to list its parameters."""
DDS_DISCOVERY_S = 4.0
"""Seconds for discovery over a network: Fast DDS repeats every three seconds what was lost at the start."""
HOW = (
    "let the base stop by itself when commands cease (ros2_controllers: cmd_vel_timeout; or the emergency "
    "stop of docs/safety.md; the timeout of twist_mux sends no zero): a console that has lost its link cannot stop it"
)


def node_findings(
    can_learn: Callable[[str], bool] = lambda type_name: False, alone_hint: str = "", settle: float = DISCOVERY_S
) -> list[DoctorFinding]:
    """Run the checks from a node on this process's middleware, after `settle` seconds of discovery.

    With `alone_hint` the nodes are counted, and the hint is given if there are no others.
    """
    rclpy.init(args=[])
    node = rclpy.create_node("_bot_console_doctor", enable_rosout=False, start_parameter_services=False)
    try:
        _spin(node, settle)
        counted = [others_finding(node, alone_hint)] if alone_hint else []
        return [*counted, *pair_findings(node), *type_findings(node, can_learn), base_finding(node)]
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _spin(node: Node, seconds: float, until: Callable[[], bool] = lambda: False) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end and not until():
        rclpy.spin_once(node, timeout_sec=0.05)


def others_finding(node: Node, alone_hint: str) -> DoctorFinding:
    """How many other nodes were discovered, without hidden ones such as those of consoles."""
    count = sum(not name.startswith("_") for name in node.get_node_names())
    if not count:
        return DoctorFinding(Level.WARN, "graph", "no other node was found", alone_hint)
    return DoctorFinding(Level.OK, "graph", f"{count} other node{'' if count == 1 else 's'}")


def pair_findings(node: Node) -> list[DoctorFinding]:
    """Publishers and subscriptions between which no messages pass."""
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
    """Types that are unknown here, or defined differently.

    Those that `can_learn` accepts are requested from their nodes when they are used.
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
    package, _, rest = type_name.partition("/")
    try:
        kind = getattr(importlib.import_module(f"{package}.msg"), rest.rpartition("/")[2])
    except (ImportError, AttributeError):
        return None
    try:
        return type_hash.text(kind)
    except (AttributeError, TypeError, KeyError):  # A class of a real ROS 2, which checks that itself.
        return ""


def base_finding(node: Node) -> DoctorFinding:
    """Whether the robot stops by itself when commands cease."""
    bases = {
        node_name_of(each)
        for topic, types in node.get_topic_names_and_types()
        if any(kind in TWISTS for kind in types)
        for each in node.get_subscriptions_info_by_topic(topic)
        if not str(each.node_name).startswith("_")
    }
    if not bases:
        return DoctorFinding(Level.NOTE, "time-out", "no node subscribes to velocity commands")
    if locks := find_locks(node):
        return lock_finding(ask_locks(node, locks, _spin))
    named = [(base, name, value) for base in sorted(bases) for name, value in time_outs(node, base).items()]
    if not named:
        return DoctorFinding(Level.WARN, "time-out", f"none was found in {', '.join(sorted(bases))}", HOW)
    listed = ", ".join(f"{base} {name} {value:g}" for base, name, value in named[:3])
    if all(value <= 0 for _, _, value in named):
        return DoctorFinding(Level.WARN, "time-out", f"{listed}: it is switched off", HOW)
    return DoctorFinding(Level.OK, "time-out", f"{listed}: make sure that it is short (0.5 s)")


def time_outs(node: Node, base: str) -> dict[str, float]:
    """The numeric parameters of a node whose names suggest command time-outs."""
    listed = _answer(node, ListParameters, f"{base}/list_parameters", ListParameters.Request())
    names = [each for each in listed.result.names if TIMEOUT.search(each)] if listed else []
    reported = (
        _answer(node, GetParameters, f"{base}/get_parameters", GetParameters.Request(names=names)) if names else None
    )
    values = [parameter_value_to_python(each) for each in reported.values] if reported else []
    return {
        name: float(value)
        for name, value in zip(names, values, strict=False)
        if isinstance(value, (int, float)) and not isinstance(value, bool)
    }


def _answer(node: Node, kind: Any, service: str, request: Any) -> Any:
    """The response of a service; None if there is none."""
    client = node.create_client(kind, service)
    try:
        _spin(node, TIMEOUT_S, client.service_is_ready)
        if not client.service_is_ready():
            return None
        answer = client.call_async(request)
        _spin(node, TIMEOUT_S, answer.done)
        return answer.result() if answer.done() else None
    finally:
        node.destroy_client(client)
