"""Loading nodes into a container."""

from __future__ import annotations

import asyncio
import threading
from functools import partial
from typing import Any

import launch.logging
from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import create_future, normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.descriptions import ComposableNode
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    prefix_namespace,
    to_parameters_list,
)

WAIT_S = 1.0


@expose_action("load_composable_node")
class LoadComposableNodes(Action):
    """Lets a running container load nodes, one after the other."""

    def __init__(self, *, composable_node_descriptions: Any, target_container: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__descriptions = composable_node_descriptions
        self.__target = target_container
        self.__done: asyncio.Future[None] | None = None
        self.__logger = launch.logging.get_logger(__name__)

    @classmethod
    def parse(cls, entity: Any, parser: Any) -> tuple[Any, dict[str, Any]]:
        """From XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["target_container"] = parser.parse_substitution(entity.get_attr("target"))
        kwargs["composable_node_descriptions"] = parse_composable_nodes(entity, parser)
        return cls, kwargs

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Done when all were loaded, or cannot be."""
        return self.__done

    def execute(self, context: Any) -> None:
        """Ask the container for each node whose condition holds."""
        from composition_interfaces.srv import LoadNode

        target = self._container_name(context)
        if target is None:
            self.__logger.error("node name not set for action: ComposableNodeContainer without a name")
            return
        requests = [request_for(each, context) for each in self.__descriptions if holds(each, context)]
        if not requests:
            return
        self.__done = create_future(context.asyncio_loop)
        client = get_ros_node(context).create_client(LoadNode, f"{target}/_container/load_node")
        worker = threading.Thread(target=self._load, args=(requests, client, target, context), daemon=True)
        worker.start()

    def _container_name(self, context: Any) -> str | None:
        from launch_ros.actions.composable_node_container import ComposableNodeContainer

        if isinstance(self.__target, ComposableNodeContainer):
            name: str | None = self.__target.node_name
        else:
            text = perform_substitutions(context, normalize_to_list_of_substitutions(self.__target))
            name = text if text.startswith("/") else None
            if name is None:
                base = context.launch_configurations.get("ros_namespace")
                name = make_namespace_absolute(prefix_namespace(base, text))
        return None if name is None or "<" in name else name

    def _load(self, requests: list[Any], client: Any, target: str, context: Any) -> None:
        try:
            for request in requests:
                if not self._load_one(request, client, target, context):
                    return
        finally:
            context.asyncio_loop.call_soon_threadsafe(self._finish)

    def _load_one(self, request: Any, client: Any, target: str, context: Any) -> bool:
        """Whether to go on with the next one."""
        while not client.wait_for_service(timeout_sec=WAIT_S):
            if context.is_shutdown:
                self.__logger.warning(f"Abandoning wait for the '{client.srv_name}' service response, due to shutdown.")
                return False
        answered = threading.Event()
        future = client.call_async(request)
        future.add_done_callback(lambda _: answered.set())
        while not answered.wait(WAIT_S):
            if context.is_shutdown:
                return False
        if future.exception() is not None:
            self.__logger.error(f"Failed to load node '{request.node_name}': {future.exception()}")
            return True
        self._report(future.result(), request, target, context)
        return True

    def _report(self, answer: Any, request: Any, target: str, context: Any) -> None:
        name = request.node_name or request.plugin_name
        if not answer.success:
            self.__logger.error(
                f"Failed to load node '{name}' of type '{request.plugin_name}' in container '{target}': "
                f"{answer.error_message}"
            )
            return
        loaded = answer.full_node_name or name
        context.asyncio_loop.call_soon_threadsafe(partial(self._count, loaded, context))
        self.__logger.info(f"Loaded node '{loaded}' in container '{target}'")

    def _count(self, name: str, context: Any) -> None:
        add_node_name(context, name)
        count = get_node_name_count(context, name)
        if count > 1:
            self.__logger.warning(
                f"there are now at least {count} nodes with the name {name} created within this launch context"
            )

    def _finish(self) -> None:
        if self.__done is not None and not self.__done.done():
            self.__done.set_result(None)


def parse_composable_nodes(entity: Any, parser: Any, *, optional: bool = False) -> list[ComposableNode]:
    """The `composable_node` elements."""
    found = []
    for each in entity.get_attr("composable_node", data_type=list, optional=optional) or ():
        kind, kwargs = ComposableNode.parse(parser, each)
        found.append(kind(**kwargs))
    return found


def holds(description: ComposableNode, context: Any) -> bool:
    """Whether a description's condition holds."""
    condition = description.condition()
    return condition is None or condition.evaluate(context)


def request_for(description: ComposableNode, context: Any) -> Any:
    """The request that loads a node, with what the launch file has set for all nodes."""
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
    everywhere = dict(
        each for each in context.launch_configurations.get("global_params", ()) if isinstance(each, tuple)
    )
    given = [everywhere] if everywhere else []
    own_parameters = evaluate_parameters(context, description.parameters or [])
    request.parameters = to_parameters_list(context, *names, [*given, *own_parameters])
    extra = evaluate_parameters(context, description.extra_arguments or [])
    request.extra_arguments = to_parameters_list(context, *names, extra)
    return request
