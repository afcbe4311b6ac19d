"""A container for nodes that are Python classes, like `rclcpp_components` for C++ classes."""

from __future__ import annotations

import importlib
import re
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
    from rclpy.executors import Executor

EXECUTABLES = ("component_container", "component_container_mt", "component_container_isolated")
PACKAGE = "rclcpp_components"
ENTRY_POINTS = "rclpy_components"


def main(*, threads: int | None = 1) -> None:
    """Run a container until it is interrupted."""
    rclpy.init()
    executor = SingleThreadedExecutor() if threads == 1 else MultiThreadedExecutor(threads)
    node = Node("ComponentManager")
    container = ComponentContainer(node, executor)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        container.close()
        node.destroy_node()
        rclpy.try_shutdown()


class ComponentContainer:
    """The services of a container, and the nodes that it has loaded."""

    def __init__(self, node: Node, executor: Executor) -> None:
        # The rclpy of PyPI lacks these interfaces, and launch_ros loads this module for every launch file.
        from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode

        self._node = node
        self._executor = executor
        self._loaded: dict[int, Node] = {}
        self._count = 0
        for kind, name, callback in (
            (LoadNode, "load_node", self._load),
            (UnloadNode, "unload_node", self._unload),
            (ListNodes, "list_nodes", self._list),
        ):
            node.create_service(kind, f"~/_container/{name}", callback)

    def close(self) -> None:
        """Destroy the nodes."""
        for each in self._loaded.values():
            each.destroy_node()
        self._loaded.clear()

    def _load(self, request: LoadNode.Request, response: LoadNode.Response) -> LoadNode.Response:
        try:
            made = make_component(request)
        except Exception as error:  # the component is user code
            response.success = False
            response.error_message = str(error)
            self._node.get_logger().error(f"{request.plugin_name}: {error}")
            return response
        self._executor.add_node(made)
        self._count += 1
        self._loaded[self._count] = made
        response.success = True
        response.unique_id = self._count
        response.full_node_name = made.get_fully_qualified_name()
        return response

    def _unload(self, request: UnloadNode.Request, response: UnloadNode.Response) -> UnloadNode.Response:
        node = self._loaded.pop(request.unique_id, None)
        response.success = node is not None
        if node is None:
            response.error_message = f"No node found with unique_id: {request.unique_id}"
            return response
        self._executor.remove_node(node)
        node.destroy_node()
        return response

    def _list(self, request: ListNodes.Request, response: ListNodes.Response) -> ListNodes.Response:
        response.unique_ids = list(self._loaded)
        response.full_node_names = [each.get_fully_qualified_name() for each in self._loaded.values()]
        return response


def make_component(request: Any) -> Node:
    """Create the requested node; raises `LookupError` if the class is not Python, and whatever the class raises."""
    arguments = ["--ros-args"]
    if request.node_name:
        arguments += ["-r", f"__node:={request.node_name}"]
    if request.node_namespace:
        arguments += ["-r", f"__ns:={request.node_namespace}"]
    for rule in request.remap_rules:
        arguments += ["-r", rule]
    overrides = [Parameter.from_parameter_msg(each) for each in request.parameters]
    options = {"cli_args": arguments, "use_global_arguments": False, "parameter_overrides": overrides}
    found = find_component(request.package_name, request.plugin_name)
    return _with_options(found, options)()


def _with_options(component: type[Any], options: dict[str, Any]) -> type[Any]:
    """Return a subclass whose nodes get options that the component itself does not pass on."""
    base: Any = next((each for each in component.__mro__ if each.__module__.split(".")[0] == "rclpy"), object)

    class Configured(base):
        def __init__(self, *args: object, **kwargs: object) -> None:
            super().__init__(*args, **{**kwargs, **options})  # pyright: ignore[reportUnknownMemberType] -- any component

    return type(component.__name__, (component, Configured), {"__module__": component.__module__})


def find_component(package: str, plugin: str) -> type[Any]:
    """Find a component's class: an entry point, `package::Class` or `package.module::Class`; raises `LookupError`."""
    # imported here, as it takes 20 ms and most launches have no container
    from bot_console.runtime.programs.installed_entry_points import installed_entry_points

    for each in installed_entry_points(ENTRY_POINTS):
        if each.name == plugin:
            return each.load()
    module, _, name = plugin.replace("::", ".").rpartition(".")
    module = module or package
    for candidate in (module, f"{module}.{_snake_case(name)}"):
        try:
            found = getattr(importlib.import_module(candidate), name, None)
        except ModuleNotFoundError as error:
            if not (error.name and candidate.startswith(error.name)):
                raise
            continue
        if isinstance(found, type):
            return found
    raise LookupError(
        f"Failed to find class with the requested plugin name. '{plugin}' is no Python class of package '{package}'; "
        "a C++ component needs a machine with ROS 2"
    )


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
