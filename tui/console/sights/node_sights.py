"""`Sights` over the console's node."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.console.calls import Calls
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sights.diagnostics import DiagnosticsWatch
from bot_console.tui.console.sights.frame_model import Frames
from bot_console.tui.console.sights.frames_watch import FramesWatch
from bot_console.tui.console.sights.images import ImageWatch
from bot_console.tui.console.sights.model import Diagnostics, Picture
from rclpy.node import Node


class NodeSights:
    """What the robot shows of itself; its methods may be called from any thread, the work is the executor's."""

    def __init__(self, node: Node, calls: Calls, graph: Callable[[], GraphWatch]) -> None:
        self._calls = calls
        self._graph = graph
        self._diagnostics = DiagnosticsWatch(node)
        self._images = ImageWatch(node)
        self._frames = FramesWatch(node)

    def follow(self, graph: GraphInfo) -> None:
        """The graph is another; called by the executor."""
        self._diagnostics.follow(graph)
        self._images.follow(graph)
        self._frames.follow(graph)

    def diagnostics(self) -> Diagnostics:
        """What the parts of the robot say of themselves."""
        return self._diagnostics.diagnostics()

    def look_at(self, topic: str, columns: int, rows: int) -> None:
        """Receive the images of this topic."""

        async def look() -> None:
            self._images.look_at(topic, columns, rows, self._graph().info)

        self._calls.run(look(), lambda why: None)

    def picture(self) -> Picture:
        """The newest image."""
        return self._images.picture()

    def look_at_frames(self, on: bool) -> None:
        """Listen to `/tf` and `/tf_static` from now on, or stop listening."""

        async def look() -> None:
            self._frames.look(on, self._graph().info)

        self._calls.run(look(), lambda _: None)

    def look_at_nodes(self, on: bool) -> None:
        """Ask the nodes of the graph whether they live from now on, or no more."""

        async def look() -> None:
            self._graph().look_at_nodes(on)

        self._calls.run(look(), lambda _: None)

    def frames(self) -> Frames:
        """What was heard about frames while they were listened to."""
        return self._frames.frames()
