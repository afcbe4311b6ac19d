"""The graph as a node sees it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw import names
from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.endpoints import ClientEndpoint, Endpoint, NodeId, ServiceEndpoint
from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError
from rclpy.impl.topic_names import expand_name, remapped

if TYPE_CHECKING:
    from rclpy.type_hash import TypeHash

Served = ServiceEndpoint | ClientEndpoint
NamesAndTypes = list[tuple[str, list[str]]]
NANO = 1_000_000_000


def _collect(pairs: Iterable[tuple[str, str]]) -> NamesAndTypes:
    found: dict[str, set[str]] = {}
    for name, kind in pairs:
        found.setdefault(name, set()).add(kind)
    return [(name, sorted(kinds)) for name, kinds in sorted(found.items())]


class NodeGraph:
    """Graph queries of `Node`."""

    _ros_bus: Bus

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """All topics with their types, by name."""
        self._ros_use()
        endpoints = [*self._ros_bus.publishers(), *self._ros_bus.subscriptions()]
        return _collect((each.topic, each.type_name) for each in endpoints)

    def get_service_names_and_types(self) -> NamesAndTypes:
        """All services with their types, by name."""
        self._ros_use()
        return _collect((each.name, each.type_name) for each in self._ros_bus.servers())

    def get_node_names(self) -> list[str]:
        """The names of all nodes, without namespaces."""
        self._ros_use()
        return [each.name for each in self._ros_bus.nodes()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """The full names of all nodes."""
        return [f"{space.rstrip('/')}/{name}" for name, space in self.get_node_names_and_namespaces()]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Name and namespace of all nodes."""
        self._ros_use()
        return [(each.name, each.namespace) for each in self._ros_bus.nodes()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Name, namespace and enclave of all nodes."""
        self._ros_use()
        return [(each.name, each.namespace, each.enclave) for each in self._ros_bus.nodes()]

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """What a node publishes; raises `NodeNameNonExistentError`."""
        return self._ros_endpoints_of("publisher", self._ros_bus.publishers(), node_name, node_namespace)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """What a node subscribes to; raises `NodeNameNonExistentError`."""
        return self._ros_endpoints_of("subscriber", self._ros_bus.subscriptions(), node_name, node_namespace)

    def get_service_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """What services a node offers; raises `NodeNameNonExistentError`."""
        return self._ros_services_of("service", self._ros_bus.servers(), node_name, node_namespace)

    def get_client_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """What services a node asks; raises `NodeNameNonExistentError`."""
        return self._ros_services_of("client", self._ros_bus.clients(), node_name, node_namespace)

    def _ros_who(self, what: str, name: str, namespace: str) -> set[NodeId]:
        self._ros_use()
        namespace = namespace or "/"
        for argument, problem in (
            ("node_name", names.validate_node_name(name)),
            ("node_namespace", names.validate_namespace(namespace)),
        ):
            if problem:
                raise RCLError(f"failed to get {what} names and types: {argument} argument is invalid: {problem[0]}")
        found = {each for each in self._ros_bus.nodes() if each.name == name and each.namespace == namespace}
        if not found:
            raise NodeNameNonExistentError(f"cannot get {what} names and types for nonexistent node: error not set")
        return found

    def _ros_endpoints_of(self, what: str, endpoints: Sequence[Endpoint], name: str, namespace: str) -> NamesAndTypes:
        who = self._ros_who(what, name, namespace)
        return _collect((each.topic, each.type_name) for each in endpoints if each.node in who)

    def _ros_services_of(self, what: str, services: Sequence[Served], name: str, namespace: str) -> NamesAndTypes:
        who = self._ros_who(what, name, namespace)
        return _collect((each.name, each.type_name) for each in services if each.node in who)

    def count_publishers(self, topic_name: str) -> int:
        """How many publishers a topic has; the name is expanded but not remapped."""
        name = expand_name(self, topic_name)
        return sum(each.topic == name for each in self._ros_bus.publishers())

    def count_subscribers(self, topic_name: str) -> int:
        """How many subscriptions a topic has; the name is expanded but not remapped."""
        name = expand_name(self, topic_name)
        return sum(each.topic == name for each in self._ros_bus.subscriptions())

    def count_clients(self, service_name: str) -> int:
        """How many clients a service has; the name is expanded but not remapped."""
        name = expand_name(self, service_name, service=True)
        return sum(each.name == name for each in self._ros_bus.clients())

    def count_services(self, service_name: str) -> int:
        """How many servers a service has; the name is expanded but not remapped."""
        name = expand_name(self, service_name, service=True)
        return sum(each.name == name for each in self._ros_bus.servers())

    def get_publishers_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[Any]:
        """The publishers of a topic; the name is remapped."""
        return self._ros_infos(self._ros_bus.publishers(), topic_name, no_mangle, publisher=True)

    def get_subscriptions_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[Any]:
        """The subscriptions of a topic; the name is remapped."""
        return self._ros_infos(self._ros_bus.subscriptions(), topic_name, no_mangle, publisher=False)

    def _ros_infos(self, endpoints: Sequence[Endpoint], topic: str, no_mangle: bool, *, publisher: bool) -> list[Any]:
        from rclpy.impl.qos_in_effect import in_effect
        from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum

        name = topic if no_mangle else remapped(self, expand_name(self, topic))
        kind = TopicEndpointTypeEnum.PUBLISHER if publisher else TopicEndpointTypeEnum.SUBSCRIPTION
        return [
            TopicEndpointInfo(
                node_name=each.node.name,
                node_namespace=each.node.namespace,
                topic_type=each.type_name,
                topic_type_hash=_type_hash(each),
                endpoint_type=kind,
                endpoint_gid=list(each.gid),
                qos_profile=in_effect(each.qos),
            )
            for each in endpoints
            if each.topic == name
        ]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Whether a node is there, or comes within the time (s)."""
        clock = current().clock
        deadline = clock.steady_ns() + int(timeout * NANO)
        wakeup = clock.wakeup()
        forget = self._ros_bus.on_graph_change(wakeup.set)
        try:
            while fully_qualified_node_name not in self.get_fully_qualified_node_names():
                if clock.steady_ns() >= deadline:
                    return False
                wakeup.wait(deadline)
                wakeup.clear()
            return True
        finally:
            forget()

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """A topic's full name, remapped unless told otherwise; raises `RCLError`."""
        from rclpy.impl.topic_names import resolve

        return resolve(self, topic, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """A service's full name, remapped unless told otherwise; raises `RCLError`."""
        from rclpy.impl.topic_names import resolve

        return resolve(self, service, only_expand=only_expand, service=True)

    def _ros_use(self) -> None:
        raise NotImplementedError


def _type_hash(endpoint: Endpoint) -> TypeHash:
    from rclpy.type_hash import type_hash_from, type_hash_of

    told = endpoint.type_hash
    return type_hash_of(endpoint.message_class) if told is None else type_hash_from(told)
