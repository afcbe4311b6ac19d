"""The launch's own node, for actions that use ROS."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import rclpy
from bot_console.runtime.process import current
from launch.event_handlers import OnShutdown
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from rclpy.context import Context
    from rclpy.executors import Executor
    from rclpy.node import Node

KEY = "ros_adapter"


class ROSAdapter:
    """A node with a context of its own, spun in a separate thread while the launch runs."""

    def __init__(self, *, argv: list[str] | None = None) -> None:
        self._context = rclpy.Context()
        rclpy.init(args=argv or [], context=self._context)
        self._node = rclpy.create_node(f"launch_ros_{current().pid}", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._running = True
        self._thread = threading.Thread(target=self._spin, name="launch_ros", daemon=True)
        self._thread.start()

    def _spin(self) -> None:
        try:
            while self._running:
                self._executor.spin_once(timeout_sec=1.0)
        except (ExternalShutdownException, KeyboardInterrupt):
            return

    def shutdown(self) -> None:
        """Leave the graph."""
        if not self._running:
            return
        self._running = False
        self._executor.wake()
        self._thread.join(2.0)
        self._node.destroy_node()
        rclpy.try_shutdown(context=self._context)

    @property
    def ros_node(self) -> Node:
        """The node."""
        return self._node

    @property
    def ros_context(self) -> Context:
        """The context of the node."""
        return self._context

    @property
    def ros_executor(self) -> Executor:
        """The executor that spins the node."""
        return self._executor


def get_ros_adapter(context: LaunchContext) -> ROSAdapter:
    """Return a launch's adapter, created on first use."""
    found = context.get_locals_as_dict().get(KEY)
    if found is None:
        found = ROSAdapter(argv=context.argv)
        context.extend_globals({KEY: found})
        made = found

        def launch_ends(event: object, context: LaunchContext) -> None:
            made.shutdown()

        context.register_event_handler(OnShutdown(on_shutdown=launch_ends), append=True)
    return found


def get_ros_node(context: LaunchContext) -> Node:
    """Return a launch's node."""
    return get_ros_adapter(context).ros_node
