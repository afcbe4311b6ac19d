"""The imports and other work that the fork server does once for all nodes forked from it."""

from __future__ import annotations

from bot_console.runtime.importer import install
from bot_console.runtime.rosidl.names import KINDS

INTERFACES = ("action_msgs", "builtin_interfaces", "geometry_msgs", "nav_msgs", "rcl_interfaces", "sensor_msgs",
              "std_msgs", "std_srvs", "tf2_msgs")  # fmt: skip
"""Packages whose interfaces most nodes import."""
MODULES = ("rclpy.executors", "rclpy.qos", "bot_console.runtime.children.own_fork_server",
           "bot_console.runtime.workspace.launched", "bot_console.runtime.rosidl.cdr_read",
           "bot_console.runtime.rosidl.cdr_write", "bot_console.runtime.rmw.zenoh.bus",
           "bot_console.runtime.rmw.zenoh.domain.domain_bus", "bot_console.runtime.rmw.zenoh.domain.mesh")  # fmt: skip


SHARED = ("rclpy.validate_node_name", "bot_console.runtime.workspace.launched")
"""Modules that a launch imports, too."""


def import_shared() -> None:
    """Import what both the server and its parent need, before one is forked from the other."""
    import gc
    import importlib

    gc.disable()  # the imported modules stay
    install()
    for name in SHARED:
        importlib.import_module(name)


def warm_up() -> None:
    """Import the runtime, and create and destroy one node. No thread and no middleware session is left."""
    import contextlib
    import gc
    import importlib

    from bot_console.runtime.rmw.zenoh.session import preload
    from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of

    install()
    for package in INTERFACES:
        for kind in KINDS:
            with contextlib.suppress(ModuleNotFoundError):
                importlib.import_module(f"{package}.{kind}")
    for name in MODULES:
        importlib.import_module(name)
    with contextlib.suppress(ImportError, MemoryError):  # if memory is too small, the node reports that
        preload()
    gid_of("warm_up")  # imports the modules that hashes need
    gc.freeze()  # imported modules are not garbage: only the remains of the node need examination
    _make_one_node()


def _make_one_node() -> None:
    import rclpy
    from bot_console.runtime.rosidl import type_hash
    from std_msgs.msg import String

    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    node = rclpy.create_node("warm_up", context=context)
    try:
        node.declare_parameter("warm", True)
        node.create_publisher(String, "warm", 1).publish(String(data="up"))
        node.create_timer(1.0, lambda: None)
        executor = rclpy.executors.SingleThreadedExecutor(context=context)
        executor.add_node(node)
        executor.spin_once(timeout_sec=0.0)
        executor.shutdown()
        (graph,) = context.bus.tables()
        for endpoint in (*graph.publishers.all(), *graph.subscriptions.all()):
            type_hash.text(endpoint.message_class)
        for service in graph.servers.all():
            type_hash.text(service.service_class)
    finally:
        node.destroy_node()
        rclpy.try_shutdown(context=context)
