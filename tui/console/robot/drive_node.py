"""The connection to the robot, in a separate node and thread, so that a stop does not wait for the console's other
work.
"""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Sequence

import rclpy
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.robot.drive_link import DriveLink, GraphRobots
from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

NAME = "_bot_console_drive"


class DriveNode:
    """Serves a `DriveLink`, so that the robot's lock is heard while the graph and parameters are being read.

    When 500 nodes appear at once, the console's own thread is busy for seconds.
    """

    def __init__(
        self, context: Context, fault: Callable[[Exception], None], means: Sequence[ConfiguredMeans] = ()
    ) -> None:
        """`fault` receives each exception in what this node serves; everything else continues.

        `means` stop robots that have no lock.
        """
        self.context = context
        self._fault = fault
        self._node = rclpy.create_node(
            NAME, context=context, use_global_arguments=False, enable_rosout=False, start_parameter_services=False
        )
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self._node)
        self.link = DriveLink(self._node, means=means)
        self._thread = threading.Thread(target=self._spin, name="bot-console-drive", daemon=True)
        self._closed = False

    def start(self) -> None:
        """Start serving until `close`."""
        self._thread.start()

    def _spin(self) -> None:
        while not self._closed and self.context.ok():
            try:
                with contextlib.suppress(ExternalShutdownException):
                    self._executor.spin()
            except Exception as error:  # whatever it is, it must still be possible to stop the robot
                self._fault(error)

    def follow(self, graph: GraphInfo) -> None:
        """Find the robots of a graph in the calling thread, and apply the result in the thread that serves the link."""
        self._executor.create_task(self.link.take, GraphRobots.of(graph))

    def follow_alone(self) -> None:
        """Find the robots through this node once, because the console's main node has failed."""
        if not self._closed:
            self._executor.create_task(lambda: GraphWatch(self._node, self.link.follow).poll())

    def close(self) -> None:
        """Stop serving and leave the graph; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        self._executor.shutdown(timeout_sec=1.0)
        self._node.destroy_node()
