"""Checks whether the robot stops by itself when commands cease: by its emergency stop, or by a time-out of its base."""

from __future__ import annotations

import re
from typing import Any

from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.cli.doctor.locks import find_locks, lock_finding, query_locks
from bot_console.tui.cli.doctor.spinning import spin_for
from bot_console.tui.console.graph.full_name import node_name_of
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

TWISTS = ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")
TIMEOUT_PARAMETER = re.compile(
    r"(cmd|command|vel|twist|input|watchdog).*time_?out|time_?out.*(cmd|command|vel)|watchdog", re.I
)
"""Matches the names of parameters for time-outs that stop a base or a controller when commands cease."""
TIMEOUT_S = 3.0
"""Seconds to wait for a node's parameter services."""
HOW = (
    "let the base stop by itself when commands cease (ros2_controllers: cmd_vel_timeout; or the emergency "
    "stop of docs/safety.md; the timeout of twist_mux sends no zero): a console that has lost its link cannot stop it"
)


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
        return lock_finding(query_locks(node, locks, spin_for))
    named = [(base, name, value) for base in sorted(bases) for name, value in timeout_parameters(node, base).items()]
    if not named:
        return DoctorFinding(Level.WARN, "time-out", f"none was found in {', '.join(sorted(bases))}", HOW)
    listed = ", ".join(f"{base} {name} {value:g}" for base, name, value in named[:3])
    if all(value <= 0 for _, _, value in named):
        return DoctorFinding(Level.WARN, "time-out", f"{listed}: it is switched off", HOW)
    return DoctorFinding(Level.OK, "time-out", f"{listed}: make sure that it is short (0.5 s)")


def timeout_parameters(node: Node, base: str) -> dict[str, float]:
    """The numeric parameters of a node whose names suggest command time-outs, with their values."""
    listed = _answer(node, ListParameters, f"{base}/list_parameters", ListParameters.Request())
    names = [each for each in listed.result.names if TIMEOUT_PARAMETER.search(each)] if listed else []
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
    """Call a service; returns the response, or None if there is none in time."""
    client = node.create_client(kind, service)
    try:
        spin_for(node, TIMEOUT_S, client.service_is_ready)
        if not client.service_is_ready():
            return None
        answer = client.call_async(request)
        spin_for(node, TIMEOUT_S, answer.done)
        return answer.result() if answer.done() else None
    finally:
        node.destroy_client(client)
