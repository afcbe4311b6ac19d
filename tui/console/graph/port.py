"""The ROS graph, as the panes watch it. Standard library only. What is known is in `ConsoleSnapshot.graph`."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Protocol

from bot_console.tui.console.answer import Answer


class Graph(Protocol):
    """Watches what costs the nodes something only while somebody looks at it."""

    def write_launch(self, path: str) -> Answer:
        """Write a launch file and a parameter file that start the running nodes again, as far as that can be known."""
        ...

    def change_state(self, node: str, transition: str) -> Future[Answer]:
        """Request a transition of a lifecycle node by its label; answered with the new state, or why it failed."""
        ...

    def watch_nodes(self, on: bool, requester: str) -> None:
        """Check which nodes do not respond (`GraphInfo.silent`) while a requester wants it, unless that is known from
        another source.
        """
        ...
