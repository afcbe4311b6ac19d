"""Loading nodes into a container."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.action import Action
from launch.frontend import expose_action
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.utilities import (
    create_future,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch.utilities.type_utils import perform_typed_substitution
from launch_ros.actions.lifecycle_node import make_active
from launch_ros.actions.node import Node
from launch_ros.descriptions import ComposableLifecycleNode, ComposableNode, ParameterFile
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    normalize_parameter_dict,
    prefix_namespace,
    to_parameters_list,
)
from launch_ros.utilities.service_calls import answered_call

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


@expose_action("load_composable_node")
class LoadComposableNodes(Action):
    """Loads nodes into a running container, one after the other."""

    def __init__(self, *, composable_node_descriptions: Any, target_container: Any, **kwargs: Condition | None) -> None:
        ensure_argument_type(
            target_container, (*SomeSubstitutionsType_types_tuple, Node), "target_container", "LoadComposableNodes"
        )
        super().__init__(**kwargs)
        self.__descriptions = composable_node_descriptions
        self.__target = target_container
        self.__done: asyncio.Future[None] | None = None
        self.__logger = launch.logging.get_logger(__name__)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["target_container"] = parser.parse_substitution(entity.get_attr("target"))
        kwargs["composable_node_descriptions"] = parse_composable_nodes(entity, parser)
        return cls, kwargs

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Return a future that is done when all nodes were loaded or have failed."""
        return self.__done

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Ask the container to load each node whose condition holds."""
        # The rclpy of PyPI lacks these interfaces, and launch files without composable nodes do not need them.
        from composition_interfaces.srv import LoadNode

        target = self._container_name(context)
        wanted = [each for each in self.__descriptions if condition_holds(each, context)]
        requests = [request_for(each, context) for each in wanted]
        if not requests:
            return None
        self.__done = create_future(context.asyncio_loop)
        client = get_ros_node(context).create_client(LoadNode, f"{target}/_container/load_node")
        worker = threading.Thread(target=self._load, args=(requests, client, target, context), daemon=True)
        worker.start()
        started = [self._autostart(each, request, context) for each, request in zip(wanted, requests, strict=True)]
        return [each for each in started if each is not None] or None

    def _autostart(self, description: Any, request: Any, context: LaunchContext) -> Action | None:
        """Return the action that activates a loaded lifecycle node; None if the node is not to be activated."""
        if not isinstance(description, ComposableLifecycleNode):
            return None
        namespace = request.node_namespace.strip("/")
        name = f"/{namespace}/{request.node_name}" if namespace else f"/{request.node_name}"
        description.init_lifecycle_event_manager(context, name)
        if not perform_typed_substitution(context, description.node_autostart, bool):
            return None
        self.__logger.info(f"Autostart enabled for requested lifecycle node {name}")
        return make_active(name)

    def _container_name(self, context: LaunchContext) -> str:
        """Return the container's full name, or the given text unchanged: pushed namespaces are not applied to it."""
        if isinstance(self.__target, Node):
            return self.__target.node_name
        return perform_substitutions(context, normalize_to_list_of_substitutions(self.__target))

    def _load(self, requests: list[Any], client: object, target: str, context: LaunchContext) -> None:
        try:
            for request in requests:
                self._load_one(request, client, target, context)
        finally:
            _run_in_loop(context, self._finish)

    def _load_one(self, request: Any, client: Any, target: str, context: LaunchContext) -> None:
        future = answered_call(client, request, context, self.__logger)
        if future is None:
            return
        if future.exception() is not None:
            self.__logger.error(f"Failed to load node '{request.node_name}': {future.exception()}")
            return
        self._report(future.result(), request, target, context)

    def _report(self, answer: Any, request: Any, target: str, context: LaunchContext) -> None:
        name = answer.full_node_name or request.node_name
        if not answer.success:
            self.__logger.error(
                f"Failed to load node '{name}' of type '{request.plugin_name}' in container '{target}': "
                f"{answer.error_message}"
            )
            return
        _run_in_loop(context, _count, name, target, context)
        self.__logger.info(f"Loaded node '{answer.full_node_name}' in container '{target}'")

    def _finish(self) -> None:
        if self.__done is not None and not self.__done.done():
            self.__done.set_result(None)


def _run_in_loop(context: LaunchContext, function: Callable[..., object], *args: object) -> None:
    """Run a function in the launch's loop, unless the launch has ended meanwhile."""
    loop = context.asyncio_loop
    if loop is not None:
        with suppress(RuntimeError):  # it has just been closed
            loop.call_soon_threadsafe(function, *args)


def _count(name: str, target: str, context: LaunchContext) -> None:
    add_node_name(context, name)
    count = get_node_name_count(context, name)
    if count > 1:
        launch.logging.get_logger(target).warning(
            f"there are now at least {count} nodes with the name {name} created within this launch context"
        )


def parse_composable_nodes(entity: Entity, parser: Parser, *, optional: bool = False) -> list[ComposableNode]:
    """Parse the `composable_node` elements."""
    found: list[ComposableNode] = []
    for each in entity.get_attr("composable_node", data_type=list, optional=optional) or ():
        kind, kwargs = ComposableNode.parse(parser, each)
        found.append(kind(**kwargs))
    return found


def condition_holds(description: ComposableNode, context: LaunchContext) -> bool:
    """Whether a description's condition holds."""
    condition = description.condition()
    return condition is None or condition.evaluate(context)


def request_for(description: ComposableNode, context: LaunchContext) -> Any:
    """Return the request that loads a node, including what the launch file has set for all nodes."""
    from composition_interfaces.srv import LoadNode

    request = LoadNode.Request()
    request.package_name = perform_substitutions(context, description.package)
    request.plugin_name = perform_substitutions(context, description.node_plugin)
    if description.node_name is not None:
        request.node_name = perform_substitutions(context, description.node_name)
    base = context.launch_configurations.get("ros_namespace")
    own = description.node_namespace
    namespace = prefix_namespace(base, None if own is None else perform_substitutions(context, own))
    if namespace is not None:
        request.node_namespace = make_namespace_absolute(namespace) or ""
    rules = [*(context.launch_configurations.get("ros_remaps") or ())]
    rules += [
        (perform_substitutions(context, source), perform_substitutions(context, target))
        for source, target in description.remappings or ()
    ]
    request.remap_rules = [f"{source}:={target}" for source, target in rules]
    names = (request.node_name, request.node_namespace)
    everywhere = context.launch_configurations.get("global_params") or ()
    given = [*map(_global_parameters, everywhere), *(description.parameters or ())]
    request.parameters = _messages(context, names, given)
    request.extra_arguments = _messages(context, names, description.extra_arguments or ())
    return request


def _global_parameters(given: Any) -> Any:
    """Return what `SetParameter` or `SetParametersFromFile` has set, as an entry of a node's parameters."""
    if isinstance(given, tuple):
        return normalize_parameter_dict({given[0]: given[1]})
    path = Path(given).resolve()
    if not path.is_file():
        raise AssertionError
    return ParameterFile(path)


def _messages(context: LaunchContext, names: tuple[str, str], parameters: Sequence[Any]) -> list[Any]:
    evaluated = evaluate_parameters(context, parameters)
    return [each.to_parameter_msg() for each in to_parameters_list(context, *names, evaluated)]


def get_composable_node_load_request(composable_node_description: ComposableNode, context: LaunchContext) -> Any:
    """Return the request that loads a node; None if its condition does not hold."""
    if not condition_holds(composable_node_description, context):
        return None
    return request_for(composable_node_description, context)
