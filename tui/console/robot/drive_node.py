"""The connection to the robot, in a separate node and thread, so that a stop waits for nothing else the console
does.
"""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Sequence

import rclpy
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.robot.drive_link import DriveLink, Surroundings
from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

NAME = "_bot_console_drive"


class DriveNode:
    """Serves a `DriveLink`, so that the robot's lock is heard while graph and parameters are being read.

    When 500 nodes appear at once, the console's own thread is busy for seconds.
    """

    def __init__(
        self, context: Context, fault: Callable[[Exception], None], means: Sequence[ConfiguredMeans] = ()
    ) -> None:
        """`fault` receives an exception in anything this node serves; the rest goes on.

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
        """Serve until `close`."""
        self._thread.start()

    def _spin(self) -> None:
        while not self._closed and self.context.ok():
            try:
                with contextlib.suppress(ExternalShutdownException):
                    self._executor.spin()
            except Exception as error:  # whatever it is, the robot can still be stopped
                self._fault(error)

    def follow(self, graph: GraphInfo) -> None:
        """Find the robots of a graph: searches in the calling thread, applies the result in the thread that serves the
        link.
        """
        self._executor.create_task(self.link.take, Surroundings.of(graph))

    def follow_alone(self) -> None:
        """Find the robots without the console's own node, which has failed."""
        if not self._closed:
            self._executor.create_task(lambda: GraphWatch(self._node, self.link.follow).poll())

    def close(self) -> None:
        """Stop serving, and leave the graph; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        self._executor.shutdown(timeout_sec=1.0)
        self._node.destroy_node()
