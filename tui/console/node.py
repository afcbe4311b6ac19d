"""The console's own ROS node: hidden, and using only the public rclpy API, so that it works on every ROS system."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

import rclpy
from bot_console.tui.console.calls import Calls
from bot_console.tui.console.graph.lifecycle import LifecycleWatch
from bot_console.tui.console.graph.warning_log import GraphWarnings
from bot_console.tui.console.graph.watch import GraphEvents, GraphWatch, HaltedNodes
from bot_console.tui.console.logs.levels import LoggerLevels
from bot_console.tui.console.logs.rosout import RosoutWatch
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.plot.watch import PlotWatch
from bot_console.tui.console.robot.drive_node import DriveNode
from bot_console.tui.console.robot.pose_and_trail import WorldWatch
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

if TYPE_CHECKING:
    from bot_console.tui.console.node_ports import NodePorts
    from bot_console.tui.console.parameters.history_file import History

NAME = "_bot_console"


class ConsoleNode:
    """Serves the ports of a console with a node and an executor."""

    def __init__(
        self,
        robot: DriveNode,
        ports: NodePorts,
        graph_events: GraphEvents | None = None,
        history: History | None = None,
        *,
        active_profile: str = "",
        foreign: bool = False,
        halted: HaltedNodes | None = None,
    ) -> None:
        """`robot` stops the robot; it exists before anything here that may fail.

        In a `foreign` system nothing is requested before it is offered, since its nodes would log warnings about us.
        """
        self._ports = ports
        self._robot = robot
        self.node = rclpy.create_node(
            NAME,
            context=robot.context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
        )
        self.executor = SingleThreadedExecutor(context=robot.context)
        self.executor.add_node(self.node)
        calls = Calls(self.node, ports.gate, ports.link_delay)
        self._warnings = GraphWarnings(ports.logs.add)
        self._rosout = RosoutWatch(self.node, ports.logs.add, foreign=foreign)
        self.loggers = self._rosout.loggers
        """Names of the loggers whose lines have arrived over `/rosout`."""
        self._world = WorldWatch(self.node)
        self._graph = GraphWatch(
            self.node, self._graph_changed, graph_events, halted, foreign=foreign, link_delay=ports.link_delay
        )
        ports.logs.attach(LoggerLevels(calls, self.loggers))
        ports.plots.attach(PlotWatch(self.node))
        ports.drive.attach(self._world)
        ports.parameters.attach(self.node, calls, ports.logs.add, history, active_profile)
        ports.topics.attach(self.node, calls)
        ports.sensors.attach(self.node)
        self._lifecycle = LifecycleWatch(self.node, calls, self._graph.set_lifecycle_states)
        ports.graph.attach(self._graph, self._lifecycle)
        ports.bags.attach()

    def spin(self) -> None:
        """Spin until `close`; to be called in the console's own thread."""
        self._graph.poll()
        with contextlib.suppress(ExternalShutdownException):
            self.executor.spin()

    def close(self) -> None:
        """End `spin` and leave the graph."""
        self._graph.close()
        self._ports.topics.close()
        self.executor.shutdown(timeout_sec=1.0)
        self.node.destroy_node()

    def _graph_changed(self, graph: GraphInfo) -> None:
        self._robot.follow(graph)  # before anything that may fail, since it finds the locks
        self._warnings.follow(graph)
        self._rosout.follow()
        self._ports.parameters.follow(graph)
        self._world.follow(graph)
        self._ports.topics.follow(graph)
        self._ports.plots.follow(graph)
        self._ports.sensors.follow(graph)
        self._lifecycle.follow(graph)
