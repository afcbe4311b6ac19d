"""`Sights` over the console's node."""

from __future__ import annotations

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sights.diagnostics import DiagnosticsWatch
from bot_console.tui.console.sights.model import Diagnostics
from rclpy.node import Node


class NodeSights:
    """What the robot shows of itself; its methods may be called from any thread, the work is the executor's."""

    def __init__(self, node: Node) -> None:
        self._diagnostics = DiagnosticsWatch(node)

    def follow(self, graph: GraphInfo) -> None:
        """The graph is another; called by the executor."""
        self._diagnostics.follow(graph)

    def diagnostics(self) -> Diagnostics:
        """What the parts of the robot say of themselves."""
        return self._diagnostics.diagnostics()
