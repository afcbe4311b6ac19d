"""`Sensors` over the console's node."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.console.calls import Calls
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sensors.diagnostics import DiagnosticsWatch
from bot_console.tui.console.sensors.frame_model import Frames
from bot_console.tui.console.sensors.frames_watch import FramesWatch
from bot_console.tui.console.sensors.images import ImageWatch
from bot_console.tui.console.sensors.model import Diagnostics, Picture
from rclpy.node import Node


class NodeSensors:
    """The robot's sensor data; its methods may be called from any thread, the executor does the work."""

    def __init__(self, node: Node, calls: Calls, graph: Callable[[], GraphWatch]) -> None:
        self._calls = calls
        self._graph = graph
        self._diagnostics = DiagnosticsWatch(node)
        self._images = ImageWatch(node)
        self._frames = FramesWatch(node)

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        self._diagnostics.follow(graph)
        self._images.follow(graph)
        self._frames.follow(graph)

    def diagnostics(self) -> Diagnostics:
        """The latest diagnostics."""
        return self._diagnostics.diagnostics()

    def watch_image(self, topic: str, columns: int, rows: int) -> None:
        """Receive the images of this topic."""

        async def poll() -> None:
            self._images.watch_image(topic, columns, rows, self._graph().info)

        self._calls.run(poll(), lambda why: None)

    def picture(self) -> Picture:
        """The newest image."""
        return self._images.picture()

    def watch_frames(self, on: bool) -> None:
        """Start or stop listening to `/tf` and `/tf_static`."""

        async def poll() -> None:
            self._frames.poll(on, self._graph().info)

        self._calls.run(poll(), lambda _: None)

    def watch_nodes(self, on: bool) -> None:
        """Start or stop checking which nodes of the graph respond."""

        async def poll() -> None:
            self._graph().watch_nodes(on)

        self._calls.run(poll(), lambda _: None)

    def frames(self) -> Frames:
        """The frames received while listening."""
        return self._frames.frames()
