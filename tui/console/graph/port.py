"""The ROS graph, as the panes watch it. Standard library only. What is known is in `ConsoleSnapshot.graph`."""

from __future__ import annotations

from typing import Protocol


class Graph(Protocol):
    """Watches what costs the nodes something only while somebody looks at it."""

    def watch_nodes(self, on: bool, requester: str) -> None:
        """Check which nodes do not respond (`GraphInfo.silent`) while a requester wants it, unless that is known from
        another source.
        """
        ...
