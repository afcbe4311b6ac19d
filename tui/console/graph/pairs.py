"""Finds out why no messages pass between two existing endpoints, which ROS itself logs once or never.

Only the public rclpy API is used, so it works with every middleware.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.tui.console.graph.full_name import node_name_of
from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from rclpy import get_rmw_implementation_identifier
from rclpy.node import Node
from rclpy.qos import QoSCompatibility, qos_check_compatible

if TYPE_CHECKING:
    from bot_console.tui.console.graph.observer import Observer
    from rclpy.topic_endpoint_info import TopicEndpointInfo

RMW_ZENOH = "rmw_zenoh_cpp"
"""This middleware delivers whatever the QoS, although rclpy's check applies the rules of DDS to it as well."""

Ask = Callable[[str], "Sequence[TopicEndpointInfo]"]


class UnheardPairs:
    """Keeps findings for each topic; a topic is examined again only when its endpoints have changed."""

    def __init__(self, node: Node | Observer) -> None:
        self._publishers: Ask = node.get_publishers_info_by_topic
        self._subscriptions: Ask = node.get_subscriptions_info_by_topic
        self._nodes: dict[str, NodeInfo] = {}
        self._ends: dict[str, set[tuple[bool, str]]] = {}
        """The nodes that publish (True) and subscribe (False), by topic."""
        self._known: dict[str, tuple[str, ...]] = {}
        self.found: tuple[str, ...] = ()
        """Texts on types that keep messages from passing; the same object if nothing has changed."""
        self.incompatible: Mapping[str, tuple[IncompatiblePair, ...]] = {}
        """The node pairs with incompatible QoS, by topic; the same object if nothing has changed."""

    def follow(self, graph: GraphInfo) -> None:
        """Update the findings from a changed graph."""
        nodes = {each.name: each for each in graph.nodes}
        touched: set[str] = set()
        for name in nodes.keys() | self._nodes.keys():
            before, now = self._nodes.get(name), nodes.get(name)
            if before is not now:
                touched |= self._update_endpoints(name, _endpoints_of(before), _endpoints_of(now))
        self._nodes = nodes
        incompatible = {topic: pairs for topic, pairs in self.incompatible.items() if topic not in touched}
        for topic in touched:
            ends = self._ends[topic]
            self._known.pop(topic, None)
            if len({publishes for publishes, _ in ends}) == 2:
                publishers, subscriptions = self._publishers(topic), self._subscriptions(topic)
                if texts := _differences(topic, publishers, subscriptions):
                    self._known[topic] = texts
                if pairs := tuple(_incompatible(publishers, subscriptions)):
                    incompatible[topic] = pairs
            if not ends:
                del self._ends[topic]
        if incompatible != self.incompatible:
            self.incompatible = incompatible
        found = tuple(text for _, texts in sorted(self._known.items()) for text in texts)
        if found != self.found:
            self.found = found

    def _update_endpoints(
        self, node: str, before: set[tuple[bool, Endpoint]], now: set[tuple[bool, Endpoint]]
    ) -> set[str]:
        """Update a node's endpoints; returns the topics whose endpoints have changed."""
        for publishes, each in before - now:
            self._ends[each.name].discard((publishes, node))
        for publishes, each in now:
            self._ends.setdefault(each.name, set()).add((publishes, node))
        return {each.name for _, each in before ^ now}


def _differences(
    topic: str, publishers: Sequence[TopicEndpointInfo], subscriptions: Sequence[TopicEndpointInfo]
) -> tuple[str, ...]:
    """Texts on the differing definitions of a topic's type in its endpoints."""
    if len({hash_of(each) for each in (*publishers, *subscriptions)} - {""}) < 2:
        return ()
    pairs = ((one, other) for one in publishers for other in subscriptions)
    return tuple(dict.fromkeys(text for one, other in pairs if (text := definition_mismatch(topic, one, other))))


def _incompatible(
    publishers: Sequence[TopicEndpointInfo], subscriptions: Sequence[TopicEndpointInfo]
) -> Iterator[IncompatiblePair]:
    """The pairs of nodes whose QoS does not match; two profiles are compared once, however many nodes use them."""
    offers, requests = _by_profile(publishers), _by_profile(subscriptions)
    for offered, givers in offers.values():
        for requested, takers in requests.values():
            if reason := why_incompatible(offered, requested):
                yield from (IncompatiblePair(one, other, reason) for one in givers for other in takers)


def _by_profile(endpoints: Sequence[TopicEndpointInfo]) -> dict[Any, tuple[Any, dict[str, None]]]:
    """The nodes that use each QoS profile, without tools, which adapt their QoS."""
    found: dict[Any, tuple[Any, dict[str, None]]] = {}
    for each in endpoints:
        if not _hidden(each):
            qos = each.qos_profile
            durations = qos.deadline.nanoseconds, qos.liveliness_lease_duration.nanoseconds
            key = qos.reliability, qos.durability, qos.liveliness, durations
            found.setdefault(key, (qos, {}))[1][node_name_of(each)] = None
    return found


def why_incompatible(offered: Any, requested: Any) -> str:
    """Why the current middleware passes no messages between two QoS profiles; empty if it does."""
    if get_rmw_implementation_identifier() == RMW_ZENOH:
        return ""
    verdict, why = qos_check_compatible(offered, requested)
    return _reason_text(why) if verdict == QoSCompatibility.ERROR else ""


def _endpoints_of(node: NodeInfo | None) -> set[tuple[bool, Endpoint]]:
    """The endpoints by which a node publishes (True) and subscribes (False)."""
    if node is None:
        return set()
    return {(True, each) for each in node.publishers} | {(False, each) for each in node.subscriptions}


def unheard(
    topic: str, publishers: Sequence[TopicEndpointInfo], subscriptions: Sequence[TopicEndpointInfo]
) -> Iterable[str]:
    """The obstacles that keep the messages of a topic from passing, each with a remedy."""
    seen: set[str] = set()
    for publisher in publishers:
        for subscription in subscriptions:
            text = _pair(topic, publisher, subscription)
            if text and text not in seen:
                seen.add(text)
                yield text


def _pair(topic: str, publisher: TopicEndpointInfo, subscription: TopicEndpointInfo) -> str:
    if _hidden(publisher) or _hidden(subscription):
        return ""  # tools adapt their QoS themselves
    one, other = node_name_of(publisher), node_name_of(subscription)
    if publisher.topic_type != subscription.topic_type:
        return f"{topic}: {one} publishes {publisher.topic_type}, {other} expects {subscription.topic_type}: rename one"
    if text := definition_mismatch(topic, publisher, subscription):
        return text
    why = why_incompatible(publisher.qos_profile, subscription.qos_profile)
    return f"{topic}: {other} receives nothing from {one}: {why}; change the QoS of one of them" if why else ""


def definition_mismatch(topic: str, publisher: TopicEndpointInfo, subscription: TopicEndpointInfo) -> str:
    """A text if the two endpoints define the same type differently, which ROS does not report; else empty."""
    hashes = {hash_of(publisher), hash_of(subscription)} - {""}
    if _hidden(publisher) or _hidden(subscription) or len(hashes) < 2:
        return ""
    if publisher.topic_type != subscription.topic_type:
        return ""  # different types: reported separately
    return (
        f"{topic}: the definition of {publisher.topic_type} in {node_name_of(publisher)} differs from that in "
        f"{node_name_of(subscription)}, so no messages pass: build both from the same definition"
    )


def _reason_text(why: str) -> str:
    """The reasons that rclpy gives, less emphatic: `best effort publisher and reliable subscription`."""
    reasons = (each.strip().removeprefix("ERROR: ") for each in why.split(";"))
    return ", ".join(each[0].lower() + each[1:] for each in reasons if each)


def hash_of(endpoint: TopicEndpointInfo) -> str:
    """The type hash of an endpoint; empty if this ROS distribution, or the node's, has none."""
    text = str(getattr(endpoint, "topic_type_hash", None) or "")
    digest = text.removeprefix("RIHS01_")
    return text if digest != text and set(digest) != {"0"} else ""


def _hidden(endpoint: TopicEndpointInfo) -> bool:
    return str(endpoint.node_name).startswith("_")
