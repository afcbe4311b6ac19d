"""The ROS graph as the console sees it: asked twice a second, a new object only when something changed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from rclpy.node import Node

ACTION_SERVER_TOPIC = "/_action/status"
PERIOD = 0.5
"""Seconds between two looks."""


class GraphWatch:
    """Keeps `info` up to date while the node spins, and tells `changed` of each new graph."""

    def __init__(self, node: Node, changed: Callable[[GraphInfo], None]) -> None:
        self.info = GraphInfo()
        self._node = node
        self._changed = changed
        self._raw: Any = None
        node.create_timer(PERIOD, self.look)

    def look(self) -> None:
        """Ask for the graph now."""
        node = self._node
        names = sorted(set(node.get_node_names_and_namespaces()))
        raw = (
            [(name, space, self._ask(name, space)) for name, space in names],
            node.get_topic_names_and_types(),
            node.get_service_names_and_types(),
        )
        if raw == self._raw:
            return
        self._raw = raw
        nodes = sorted((self._describe(*each) for each in raw[0]), key=lambda each: each.name)
        self.info = GraphInfo(tuple(nodes), _endpoints(raw[1]), _endpoints(raw[2]))
        self._changed(self.info)

    def _ask(self, name: str, space: str) -> tuple[Any, ...]:
        node = self._node
        asked = (
            node.get_publisher_names_and_types_by_node,
            node.get_subscriber_names_and_types_by_node,
            node.get_service_names_and_types_by_node,
            node.get_client_names_and_types_by_node,
        )
        answers: list[Any] = []
        for ask in asked:
            try:
                answers.append(ask(name, space))
            except RuntimeError:
                # The node left between the two questions.
                answers.append([])
        return tuple(answers)

    def _describe(self, name: str, space: str, parts: tuple[Any, ...]) -> NodeInfo:
        publishers, subscriptions, services, clients = parts
        return NodeInfo(
            f"{space.rstrip('/')}/{name}",
            tuple(self._with_qos(each, name, space, publisher=True) for each in _endpoints(publishers)),
            tuple(self._with_qos(each, name, space, publisher=False) for each in _endpoints(subscriptions)),
            _endpoints(services),
            _endpoints(clients),
            _actions(publishers),
            _actions(subscriptions),
        )

    def _with_qos(self, endpoint: Endpoint, name: str, space: str, *, publisher: bool) -> Endpoint:
        ask = self._node.get_publishers_info_by_topic if publisher else self._node.get_subscriptions_info_by_topic
        for each in ask(endpoint.name):
            if each.node_name == name and each.node_namespace == space:
                return Endpoint(endpoint.name, endpoint.types, qos_text(each.qos_profile))
        return endpoint


def qos_text(profile: Any) -> str:
    """A QoS profile in a few words, such as `reliable volatile 10`."""
    words = [profile.reliability.name, profile.durability.name]
    depth = "all" if profile.history.name == "KEEP_ALL" else str(profile.depth or "")
    return " ".join([*(word.lower().replace("_", " ") for word in words), depth]).strip()


def _endpoints(pairs: Sequence[tuple[str, Sequence[str]]]) -> tuple[Endpoint, ...]:
    return tuple(sorted((Endpoint(name, tuple(types)) for name, types in pairs), key=lambda each: each.name))


def _actions(topics: Sequence[tuple[str, Sequence[str]]]) -> tuple[Endpoint, ...]:
    """An action is known by its status topic: its server publishes it, its clients subscribe."""
    found: list[Endpoint] = []
    for name, _ in topics:
        if name.endswith(ACTION_SERVER_TOPIC):
            action = name[: -len(ACTION_SERVER_TOPIC)]
            feedback = dict(topics).get(action + "/_action/feedback", ())
            found.append(Endpoint(action, tuple(each.removesuffix("_FeedbackMessage") for each in feedback)))
    return tuple(found)
