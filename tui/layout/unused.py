"""Finds panes that would stay empty in a system: the World pane if no node publishes a world."""

from __future__ import annotations

import time
from collections.abc import Callable

from bot_console.tui.console.model import ConsoleSnapshot

WORLD = "world"
WORLD_TYPES = ("nav_msgs/msg/OccupancyGrid", "nav_msgs/msg/Odometry", "turtlesim/msg/Pose")
GIVE_UP_AFTER_S = 3.0
"""Seconds after the first node until a pane without data counts as unused, since a robot starts node by node."""


class UnusedPanes:
    """Finds out from consecutive snapshots which panes would stay empty."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._graph: object = None
        self._published = False
        self._since: float | None = None

    def panes(self, snapshot: ConsoleSnapshot) -> frozenset[str]:
        """The ids of the panes that would stay empty, judging by this and the earlier snapshots."""
        world = snapshot.world
        if snapshot.graph is not self._graph:
            self._graph = snapshot.graph
            self._published = any(kind in WORLD_TYPES for topic in snapshot.graph.topics for kind in topic.types)
        if not snapshot.graph.nodes or self._published or world.map or world.pose or world.fields:
            self._since = None
            return frozenset()
        if self._since is None:
            self._since = self._clock()
        return frozenset((WORLD,)) if self._clock() - self._since >= GIVE_UP_AFTER_S else frozenset()
