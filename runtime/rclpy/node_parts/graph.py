"""Graph queries of a node."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeVar

from bot_console.runtime.rmw import names
from bot_console.runtime.rmw.endpoints import Endpoint, NodeId, Owner
from bot_console.runtime.rmw.graph_tables import NamesAndTypes, collect
from bot_console.runtime.rmw.qos import Period, Policy, Profile
from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError
from rclpy.duration import Duration, Infinite
from rclpy.impl.graph_wait import require_valid, wait_until_there
from rclpy.impl.qos_policies import QoSPolicyEnum
from rclpy.node_parts.base import NodeBase
from rclpy.node_parts.topic_names import expand_name, remapped_name, resolve
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

if TYPE_CHECKING:
    from rclpy.topic_endpoint_info import TopicEndpointInfo
    from rclpy.type_hash import TypeHash


class NodeGraph(NodeBase):
    """Graph queries of `Node`."""

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """Return all topics with their types, by name; raises `RCLError` after a shutdown of the context.

        With `no_demangle`, they have their DDS names, and include the two topics of each service.
        """
        self._ros_use_graph("topic")
        tables = self._ros_bus.tables()
        if no_demangle:
            return collect(all_dds_topics(tables))
        return collect(
            pair for each in tables for ends in (each.publishers, each.subscriptions) for pair in ends.pairs()
        )

    def get_service_names_and_types(self) -> NamesAndTypes:
        """Return all services with their types, by name, including services that have only clients.

        Raises `RCLError` after a shutdown of the context.
        """
        self._ros_use_graph("service")
        tables = self._ros_bus.tables()
        return collect(pair for each in tables for ends in (each.servers, each.clients) for pair in ends.pairs())

    def _ros_use_graph(self, what: str) -> None:
        self._ros_use()
        require_valid(self.context, f"failed to get {what} names and types")

    def get_node_names(self) -> list[str]:
        """Return the names of all nodes, without namespaces."""
        self._ros_use()
        require_valid(self.context, "Failed to get node names")
        return [each.name for each in self._ros_nodes()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the full names of all nodes."""
        return [names.full_name(space, name) for name, space in self.get_node_names_and_namespaces()]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the names and namespaces of all nodes."""
        self._ros_use()
        require_valid(self.context, "Failed to get node names")
        return [(each.name, each.namespace) for each in self._ros_nodes()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return the names, namespaces and enclaves of all nodes."""
        self._ros_use()
        require_valid(self.context, "Failed to get node names")
        return [(each.name, each.namespace, each.enclave) for each in self._ros_nodes()]

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return the topics that a node publishes, with types; raises `NodeNameNonExistentError`."""
        owner = self._ros_who("publisher", node_name, node_namespace)
        if no_demangle:
            return collect(dds_topics_written(self._ros_bus.tables(), owner))
        return collect(pair for each in self._ros_bus.tables() for pair in each.publishers.of(owner))

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return the topics that a node subscribes to, with types; raises `NodeNameNonExistentError`."""
        owner = self._ros_who("subscriber", node_name, node_namespace)
        if no_demangle:
            return collect(dds_topics_read(self._ros_bus.tables(), owner))
        return collect(pair for each in self._ros_bus.tables() for pair in each.subscriptions.of(owner))

    def get_service_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the services that a node offers, with types; raises `NodeNameNonExistentError`."""
        owner = self._ros_who("service", node_name, node_namespace)
        return collect(pair for each in self._ros_bus.tables() for pair in each.servers.of(owner))

    def get_client_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the services of which a node is a client, with types; raises `NodeNameNonExistentError`."""
        owner = self._ros_who("client", node_name, node_namespace)
        return collect(pair for each in self._ros_bus.tables() for pair in each.clients.of(owner))

    def _ros_nodes(self) -> list[NodeId]:
        return [node for each in self._ros_bus.tables() for node in each.nodes()]

    def _ros_who(self, what: str, name: str, namespace: str) -> Owner:
        """Return the node that a query concerns; raises `RCLError` (invalid name) or `NodeNameNonExistentError`."""
        self._ros_use()
        require_valid(self.context, f"failed to get {what} names and types")
        owner = name, namespace or "/"
        if any(each.has(owner) for each in self._ros_bus.tables()):
            return owner
        problem = names.validate_namespace(owner[1]) or names.validate_node_name(owner[0])
        if problem:
            number = names.rmw_result_code(problem[0])
            raise RCLError(f"failed to get {what} names and types: {problem[0]}, result: {number}")
        raise NodeNameNonExistentError(f"cannot get {what} names and types for nonexistent node: error not set")

    def count_publishers(self, topic_name: str) -> int:
        """Return the number of publishers of a topic, whose name is expanded but not remapped."""
        require_valid(self.context, "Error in rcl_count_publishers")
        name = expand_name(self, topic_name)
        return sum(len(each.publishers.on(name)) for each in self._ros_bus.tables())

    def count_subscribers(self, topic_name: str) -> int:
        """Return the number of subscriptions of a topic, whose name is expanded but not remapped."""
        require_valid(self.context, "Error in rcl_count_subscribers")
        name = expand_name(self, topic_name)
        return sum(len(each.subscriptions.on(name)) for each in self._ros_bus.tables())

    def count_clients(self, service_name: str) -> int:
        """Return the number of clients of a service, whose name is expanded but not remapped."""
        require_valid(self.context, "Error in rcl_count_clients")
        name = expand_name(self, service_name, service=True)
        return sum(len(each.clients.on(name)) for each in self._ros_bus.tables())

    def count_services(self, service_name: str) -> int:
        """Return the number of servers of a service, whose name is expanded but not remapped."""
        require_valid(self.context, "Error in rcl_count_services")
        name = expand_name(self, service_name, service=True)
        return sum(len(each.servers.on(name)) for each in self._ros_bus.tables())

    def get_publishers_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[TopicEndpointInfo]:
        """Return the publishers of a topic, whose name is remapped."""
        return self._ros_infos(topic_name, no_mangle, publisher=True)

    def get_subscriptions_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[TopicEndpointInfo]:
        """Return the subscriptions of a topic, whose name is remapped."""
        return self._ros_infos(topic_name, no_mangle, publisher=False)

    def _ros_infos(self, topic: str, no_mangle: bool, *, publisher: bool) -> list[Any]:
        from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum

        require_valid(
            self.context, f"Failed to get information by topic for {'publishers' if publisher else 'subscriptions'}"
        )
        name = topic.removeprefix(TOPIC) if no_mangle else remapped_name(self, expand_name(self, topic))
        tables = [each.publishers if publisher else each.subscriptions for each in self._ros_bus.tables()]
        kind = TopicEndpointTypeEnum.PUBLISHER if publisher else TopicEndpointTypeEnum.SUBSCRIPTION
        return [
            TopicEndpointInfo(
                node_name=each.node.name,
                node_namespace=each.node.namespace,
                topic_type=type_name(each.type_name) if no_mangle else each.type_name,
                topic_type_hash=_type_hash(each),
                endpoint_type=kind,
                endpoint_gid=list(each.gid),
                qos_profile=effective_profile(each.qos),
            )
            for table in tables
            for each in table.on(name)
        ]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Wait for a node up to a time-out (s); returns whether it exists. The root namespace is the default."""
        full_name = f"/{fully_qualified_node_name.removeprefix('/')}"
        return wait_until_there(self, lambda: full_name in self.get_fully_qualified_node_names(), timeout)

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return a topic's full name, remapped unless `only_expand` is set; raises `RCLError`."""
        return resolve(self, topic, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return a service's full name, remapped unless `only_expand` is set; raises `RCLError`."""
        return resolve(self, service, only_expand=only_expand, service=True)

    def _ros_use(self) -> None:
        raise NotImplementedError


def _type_hash(endpoint: Endpoint) -> TypeHash:
    from rclpy.type_hash import type_hash_from, type_hash_of

    reported = endpoint.type_hash
    return type_hash_of(endpoint.message_class) if reported is None else type_hash_from(reported)


_P = TypeVar("_P", bound=QoSPolicyEnum)
_UNDECIDED = ("SYSTEM_DEFAULT", "BEST_AVAILABLE", "UNKNOWN")


def effective_profile(asked: Profile) -> QoSProfile:
    """Return the profile with the middleware's choices for open policies, and unlimited durations as infinite.

    Each caller gets its own object, which it may change. A profile received over the wire is converted only once.
    """
    return copy_profile(_of_wire(asked)) if isinstance(asked, tuple) else _in_effect(asked)


@lru_cache(256)  # a graph of thousands of endpoints has only a few different profiles
def _of_wire(asked: Profile) -> QoSProfile:
    return _in_effect(asked)


def _in_effect(asked: Profile) -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy[asked.history.name],
        depth=asked.depth,
        reliability=_decide(asked.reliability, ReliabilityPolicy.RELIABLE),
        durability=_decide(asked.durability, DurabilityPolicy.VOLATILE),
        liveliness=_decide(asked.liveliness, LivelinessPolicy.AUTOMATIC),
        lifespan=_limit(asked.lifespan),
        deadline=_limit(asked.deadline),
        liveliness_lease_duration=_limit(asked.liveliness_lease_duration),
        avoid_ros_namespace_conventions=isinstance(asked, QoSProfile) and asked.avoid_ros_namespace_conventions,
    )


def copy_profile(profile: QoSProfile) -> QoSProfile:
    """Return a copy of a profile; durations are shared, as they are immutable."""
    copy = QoSProfile.__new__(QoSProfile)
    for slot in QoSProfile.__slots__:
        setattr(copy, slot, getattr(profile, slot))
    return copy


def _decide(policy: Policy, default: _P) -> _P:
    return default if policy.name in _UNDECIDED else type(default)[policy.name]


def _limit(period: Period) -> Duration:
    return Duration(nanoseconds=period.nanoseconds) if period.nanoseconds else Infinite


Pair = tuple[str, str]
TOPIC = "rt"
"""Prefix of a topic's DDS name."""


def dds_topics_written(tables: Iterable[Any], owner: Owner) -> Iterator[Pair]:
    """Yield the DDS topics a node publishes: its topics, the replies of its services, the requests of its clients."""
    for each in tables:
        yield from map(_topic, each.publishers.of(owner))
        yield from map(_reply, each.servers.of(owner))
        yield from map(_request, each.clients.of(owner))


def dds_topics_read(tables: Iterable[Any], owner: Owner) -> Iterator[Pair]:
    """Yield the DDS topics a node subscribes to: its topics, its services' requests, its clients' replies."""
    for each in tables:
        yield from map(_topic, each.subscriptions.of(owner))
        yield from map(_request, each.servers.of(owner))
        yield from map(_reply, each.clients.of(owner))


def all_dds_topics(tables: Iterable[Any]) -> Iterator[Pair]:
    """Yield all topics, and both topics of each service."""
    for each in tables:
        for topics in (each.publishers, each.subscriptions):
            yield from map(_topic, topics.pairs())
        for services in (each.servers, each.clients):
            for pair in services.pairs():
                yield from (_request(pair), _reply(pair))


def _topic(pair: Pair) -> Pair:
    return f"{TOPIC}{pair[0]}", type_name(pair[1])


def _request(pair: Pair) -> Pair:
    return f"rq{pair[0]}Request", type_name(f"{pair[1]}_Request")


def _reply(pair: Pair) -> Pair:
    return f"rr{pair[0]}Reply", type_name(f"{pair[1]}_Response")


def type_name(name: str) -> str:
    """Return `std_msgs/msg/String` as `std_msgs::msg::dds_::String_`."""
    package, kind, short = name.split("/")
    return f"{package}::{kind}::dds_::{short}_"
