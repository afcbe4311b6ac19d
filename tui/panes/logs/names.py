"""The node names of log lines, spelled as in the graph: the logger `arm.left.zoo` is the node `/arm/left/zoo`."""

from __future__ import annotations

from bot_console.tui.console.model import GraphInfo, logger_of


class NodeNames:
    """The names of all nodes ever seen: log lines outlive the nodes that wrote them."""

    def __init__(self) -> None:
        self._names: dict[str, str] = {}
        self.longest = 0
        """Length of the longest name."""

        self._graph: GraphInfo | None = None

    def learn(self, graph: GraphInfo) -> bool:
        """Add the nodes of the graph; returns whether there is a new one."""
        if graph is self._graph:
            return False
        self._graph, before = graph, len(self._names)
        self._names.update({logger_of(each.name): each.name for each in graph.nodes})
        self.longest = max(map(len, self._names.values()), default=0)
        return len(self._names) > before

    def of(self, logger: str) -> str:
        """The node of a logger, followed by the rest of the logger's name: `/arm/zoo.planner`. Other names stay as they
        are.
        """
        head, rest = logger, ""
        while head:
            if head in self._names:
                return self._names[head] + rest
            head, dot, last = head.rpartition(".")
            rest = f"{dot}{last}{rest}" if dot else rest
        return logger
