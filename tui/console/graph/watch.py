"""The ROS graph as the console sees it: asked twice a second, or after an event, a new object only when it changed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from bot_console.tui.console.graph.pairs import UnheardPairs
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from rclpy.node import Node

ACTION_SERVER_TOPIC = "/_action/status"
PERIOD = 0.5
"""Seconds between two looks, where something may have changed."""

Owner = tuple[str, str]
"""Name and namespace of a node."""

Pairs = Sequence[tuple[str, Sequence[str]]]
"""Topics or services with their types."""

GraphEvents = Callable[[int, Callable[[], None]], Callable[[], None]]
"""Takes a ROS domain and what is to be called, from any thread, after each change of its graph; gives what ends that.
rclpy has none: without one the graph is asked for again and again."""


class GraphWatch:
    """Keeps `info` up to date while the node spins, and tells `changed` of each new graph.

    What has not changed is not described again, and stays the same object.
    """

    def __init__(self, node: Node, changed: Callable[[GraphInfo], None], events: GraphEvents | None = None) -> None:
        self.info = GraphInfo()
        self._node = node
        self._changed = changed
        self._nodes: dict[Owner, tuple[Any, NodeInfo]] = {}
        self._topics: Any = []
        self._services: Any = []
        self._stale = True
        self._told = events is not None
        self._unheard = UnheardPairs(node)
        self._end = events(node.context.get_domain_id(), self._event) if events else _nothing
        node.create_timer(PERIOD, self._tick)

    def _event(self) -> None:
        self._stale = True

    def _tick(self) -> None:
        if self._stale or not self._told:
            self.look()

    def close(self) -> None:
        """Hear of no more events."""
        self._end()

    def look(self) -> None:
        """Ask for the graph now."""
        self._stale = False  # before the questions: what changes meanwhile is asked for again
        node = self._node
        profiles = Profiles(node)
        nodes = {owner: self._look_at(owner, profiles) for owner in set(node.get_node_names_and_namespaces())}
        topics, services = node.get_topic_names_and_types(), node.get_service_names_and_types()
        same_nodes = nodes.keys() == self._nodes.keys() and all(
            seen is self._nodes[owner] for owner, seen in nodes.items()
        )
        if same_nodes and topics == self._topics and services == self._services:
            return
        old = self.info
        self.info = GraphInfo(
            old.nodes if same_nodes else tuple(sorted((each for _, each in nodes.values()), key=_name)),
            old.topics if topics == self._topics else _endpoints(topics),
            old.services if services == self._services else _endpoints(services),
        )
        self.info = replace(self.info, unheard=self._unheard.follow(self.info))
        self._nodes, self._topics, self._services = nodes, topics, services
        self._changed(self.info)

    def _look_at(self, owner: Owner, profiles: Profiles) -> tuple[Any, NodeInfo]:
        """What a node answers and what it means; the same object as before where the answer is the same."""
        answer, known = self._ask(*owner), self._nodes.get(owner)
        if known is None:
            return answer, _described(owner, answer, NodeInfo(""), profiles)
        return known if known[0] == answer else (answer, _described(owner, answer, known[1], profiles))

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


class Profiles:
    """The QoS profiles of one look: each topic is asked about once, however many nodes are on it."""

    def __init__(self, node: Node) -> None:
        self._ask = {True: node.get_publishers_info_by_topic, False: node.get_subscriptions_info_by_topic}
        self._found: dict[tuple[str, bool], dict[Owner, str]] = {}

    def of(self, owner: Owner, topic: str, *, publisher: bool) -> str:
        """What a node publishes or subscribes a topic with; empty where it has left."""
        key = topic, publisher
        if key not in self._found:
            infos = self._ask[publisher](topic)
            # The first one counts where a node has several.
            self._found[key] = {
                (each.node_name, each.node_namespace): qos_text(each.qos_profile) for each in infos[::-1]
            }
        return self._found[key].get(owner, "")


def _described(owner: Owner, answer: tuple[Any, ...], before: NodeInfo, profiles: Profiles) -> NodeInfo:
    """What an answer says of a node; of what the node had before, the profile is known."""
    publishers, subscriptions, services, clients = answer
    name, space = owner
    return NodeInfo(
        f"{space.rstrip('/')}/{name}",
        _with_qos(owner, publishers, before.publishers, profiles, publisher=True),
        _with_qos(owner, subscriptions, before.subscriptions, profiles, publisher=False),
        _endpoints(services),
        _endpoints(clients),
        _actions(publishers),
        _actions(subscriptions),
    )


def _with_qos(
    owner: Owner, pairs: Pairs, before: Sequence[Endpoint], profiles: Profiles, *, publisher: bool
) -> tuple[Endpoint, ...]:
    known = {(each.name, each.types): each for each in before if each.qos}
    return tuple(
        known.get((each.name, each.types))
        or Endpoint(each.name, each.types, profiles.of(owner, each.name, publisher=publisher))
        for each in _endpoints(pairs)
    )


def qos_text(profile: Any) -> str:
    """A QoS profile in a few words, such as `reliable volatile 10`."""
    words = [profile.reliability.name, profile.durability.name]
    depth = "all" if profile.history.name == "KEEP_ALL" else str(profile.depth or "")
    return " ".join([*(word.lower().replace("_", " ") for word in words), depth]).strip()


def _name(node: NodeInfo) -> str:
    return node.name


def _nothing() -> None:
    """There are no events to end."""


def _endpoints(pairs: Pairs) -> tuple[Endpoint, ...]:
    return tuple(sorted((Endpoint(name, tuple(types)) for name, types in pairs), key=lambda each: each.name))


def _actions(topics: Pairs) -> tuple[Endpoint, ...]:
    """An action is known by its status topic: its server publishes it, its clients subscribe."""
    found: list[Endpoint] = []
    for name, _ in topics:
        if name.endswith(ACTION_SERVER_TOPIC):
            action = name[: -len(ACTION_SERVER_TOPIC)]
            feedback = dict(topics).get(action + "/_action/feedback", ())
            found.append(Endpoint(action, tuple(each.removesuffix("_FeedbackMessage") for each in feedback)))
    return tuple(found)
