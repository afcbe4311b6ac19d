"""Checks whether the robot's emergency stop answers, by sending each lock a request that changes nothing."""

from __future__ import annotations

import json
import uuid
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.console.graph.full_name import node_name_of
from bot_console.tui.console.robot.stop_link import LATCHED, RELEASE, REQUEST, STATUS, is_lock
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rcl_interfaces.srv import ListParameters
from rclpy.node import Node

Spin = Callable[..., None]
"""Spins a node for a number of seconds, or until a condition holds."""
ANSWER_TIMEOUT_S = 3.0
REPEAT_S = 0.5
"""Seconds between two copies of a request; the first may be sent before the lock has discovered us."""
REMEDY = (
    "a stop would not reach it: check whether its node is frozen or hangs (kill -CONT, or restart it); until then, "
    "stop the robot with its own switch"
)


@dataclass
class LockQuery:
    """A lock that was queried: its topic, the nodes that publish it, and the answer."""

    topic: str
    nodes: Sequence[str]
    reported: bool = False
    """Whether its state has been received."""
    older: bool = False
    """Whether its version does not quote requests yet."""
    answered: bool = False


def find_locks(node: Node) -> list[LockQuery]:
    """The locks in the graph; a topic that has only subscriptions is not one."""
    found: list[LockQuery] = []
    for topic, types in sorted(node.get_topic_names_and_types()):
        if STATUS in types and is_lock(topic):
            nodes = sorted({node_name_of(each) for each in node.get_publishers_info_by_topic(topic)})
            found += [LockQuery(topic, nodes)] if nodes else []
    return found


def query_locks(node: Node, locks: Sequence[LockQuery], spin: Spin) -> Sequence[LockQuery]:
    """Query the state of every lock; an older one, which quotes no requests, via its node's parameter services."""
    question = uuid.uuid4().hex

    def heard(lock: LockQuery, message: DiagnosticStatus) -> None:
        values = {each.key: each.value for each in message.values}
        lock.reported |= "locked" in values
        lock.older = "challenge" not in values
        lock.answered |= values.get("answers") == question

    folders = {each.topic.rpartition("/")[0] for each in locks}
    publishers = [node.create_publisher(DiagnosticStatus, f"{folder}/{REQUEST}", 10) for folder in sorted(folders)]
    listening = [
        node.create_subscription(DiagnosticStatus, each.topic, partial(heard, each), LATCHED) for each in locks
    ]
    try:
        for _ in range(round(ANSWER_TIMEOUT_S / REPEAT_S)):
            for publisher in publishers:
                publisher.publish(_question(question))
            spin(node, REPEAT_S, lambda: all(each.answered for each in locks))
        for each in locks:
            if each.reported and each.older:
                each.answered = any(_serves(node, name, spin) for name in each.nodes)
    finally:
        for publisher in publishers:
            node.destroy_publisher(publisher)
        for subscription in listening:
            node.destroy_subscription(subscription)
    return locks


def _question(question: str) -> DiagnosticStatus:
    """A release of no stops, which changes nothing in locks of any version."""
    nothing = json.dumps([question])
    values: Mapping[str, str] = {REQUEST: RELEASE, "ids": "[]", "of": nothing, "question": question}
    return DiagnosticStatus(
        level=DiagnosticStatus.OK,
        name="bot-console doctor",
        hardware_id=question,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def _serves(node: Node, name: str, spin: Spin) -> bool:
    """Whether a node answers a service call; the thread that answers also handles stop requests."""
    client: Any = node.create_client(ListParameters, f"{name}/list_parameters")
    try:
        spin(node, ANSWER_TIMEOUT_S, client.service_is_ready)
        if not client.service_is_ready():
            return False
        response = client.call_async(ListParameters.Request())
        spin(node, ANSWER_TIMEOUT_S, response.done)
        return response.done() and response.result() is not None
    finally:
        node.destroy_client(client)


def lock_finding(locks: Sequence[LockQuery]) -> DoctorFinding:
    """Whether all locks have answered."""
    silent = [each for each in locks if not each.answered]
    if not silent:
        return DoctorFinding(Level.OK, "time-out", f"the robot has an emergency stop that answers ({_listed(locks)})")
    return DoctorFinding(Level.FAIL, "time-out", f"the emergency stop does not answer ({_listed(silent)})", REMEDY)


def _listed(locks: Sequence[LockQuery]) -> str:
    names = [f"{each.topic} of {', '.join(each.nodes)}" for each in locks]
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")
