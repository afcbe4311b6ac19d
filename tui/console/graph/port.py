"""The port for the ROS graph, as panes use it. Standard library only. The graph itself is `ConsoleSnapshot.graph`."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Protocol

from bot_console.tui.console.answer import Answer


class Graph(Protocol):
    """Requests concerning the graph, and checks that burden the nodes, so they run only while somebody looks."""

    def write_launch(self, path: str) -> Answer:
        """Write a launch file and a parameter file that start the running nodes again, as far as they are known."""
        ...

    def change_state(self, node: str, transition: str) -> Future[Answer]:
        """Request a transition of a lifecycle node by its label; the answer is the new state, or why it failed."""
        ...

    def watch_nodes(self, on: bool, requester: str) -> None:
        """Check which nodes do not respond (`GraphInfo.silent`) while a requester wants it, unless another source
        reports it.
        """
        ...
