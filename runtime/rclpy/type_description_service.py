"""The service `~/get_type_description` of a node."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import weakref
from collections import deque
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.bus import Bus, Thing
from bot_console.runtime.rmw.endpoints import ServiceEndpoint
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.impl.entity import Entity
from rclpy.parameter import Parameter
from type_description_interfaces.srv import GetTypeDescription

if TYPE_CHECKING:
    from rclpy.node_parts.parameters import NodeParameters

START_TYPE_DESCRIPTION_SERVICE_PARAM = "start_type_description_service"


class TypeDescriptionService:
    """Declares the read-only parameter that enables the service, and starts the service unless it is false."""

    def __init__(self, node: NodeParameters) -> None:
        self._node = node
        self.service_name = f"{node.get_name()}/get_type_description"
        name = START_TYPE_DESCRIPTION_SERVICE_PARAM
        if not node.has_parameter(name):
            description = "If enabled, start the ~/get_type_description service."
            node.declare_parameter(name, True, ParameterDescriptor(description=description, read_only=True))
        parameter = node.get_parameter(name)
        self.enabled = parameter.type_ == Parameter.Type.BOOL and parameter.value
        if parameter.type_ not in (Parameter.Type.BOOL, Parameter.Type.NOT_SET):
            node.get_logger().error(f"Invalid type for parameter '{name}' {parameter.type_!r} should be bool")
        self._service: Any = None
        if self.enabled:
            self._service = node.create_service(GetTypeDescription, self.service_name, self._answer)

    def outlive_destroy(self) -> None:
        """Stay in the graph, unresponsive, after the node is destroyed: upstream keeps it with the node object.

        It disappears with the node object or with the context, whichever ends first.
        """
        service, node = self._service, self._node
        if service is None:
            return
        endpoint = service.endpoint
        node._ros_entities.pop(service, None)
        service.destroyed = True
        service.detach()
        endpoint.queue = deque(maxlen=0)
        endpoint.notify = _nothing
        node.context.lingering.add(endpoint)
        node._ros_bus.disown(endpoint)
        weakref.finalize(node, _vanish, node._ros_bus, node.context.lingering, endpoint).atexit = False

    def _answer(self, request: Any, response: Any) -> Any:
        """Describe a type that an entity of this node uses, found by its hash; the messages are rcl's."""
        from bot_console.runtime.rosidl.type_hash import digest_from

        try:
            digest_from(request.type_hash)
        except ValueError:
            self._node.get_logger().error(f"Failed to parse type hash '{request.type_hash}'")
            response.failure_reason = "Failed to parse type hash"
            return response
        found = self._find(request.type_hash)
        if found is None:
            response.failure_reason = "Type not currently in use by this node"
            return response
        _fill(response, found, request.include_type_sources)
        response.successful = True
        return response

    def _find(self, wanted: str) -> Any:
        from bot_console.runtime.rosidl.type_hash import text

        return next((cls for cls in self._types() if text(cls) == wanted), None)

    def _types(self) -> Iterator[Any]:
        node = self._node
        for entity in (*node._ros_publishers, *node.subscriptions):
            yield entity.msg_type
        for entity in (*node.services, *node.clients):
            yield entity.srv_type
        for entity in node.waitables:
            if isinstance(entity, Entity):
                yield from entity.interfaces()


def _nothing() -> None:
    """Ignore a notification."""


def _vanish(bus: Bus, lingering: set[Thing], endpoint: ServiceEndpoint) -> None:
    lingering.discard(endpoint)
    bus.remove(endpoint)


def _fill(response: Any, cls: Any, with_sources: bool) -> None:
    from bot_console.runtime.rosidl.type_description import describe

    description = describe(cls)
    target = response.type_description
    target.type_description = _individual(description["type_description"])
    target.referenced_type_descriptions = [_individual(each) for each in description["referenced_type_descriptions"]]
    if with_sources:
        names = (target.type_description, *target.referenced_type_descriptions)
        response.type_sources = [_source(each.type_name) for each in names]


def _individual(row: Mapping[str, Any]) -> Any:
    from type_description_interfaces.msg import Field, FieldType, IndividualTypeDescription

    fields = [Field(name=each["name"], type=FieldType(**each["type"])) for each in row["fields"]]
    return IndividualTypeDescription(type_name=row["type_name"], fields=fields)


def _source(name: str) -> Any:
    """Return the source file of a type; empty for types that are derived from another definition."""
    from bot_console.runtime.rosidl.texts import definition_text
    from type_description_interfaces.msg import TypeSource

    package, kind, short = name.split("/")
    text = definition_text(package, kind, short)
    if text is None:
        return TypeSource(type_name=name, encoding="implicit")
    return TypeSource(type_name=name, encoding=kind, raw_file_contents=text)
