"""What the pane says of nodes whose parameters are gone, or that are in the graph but do not answer."""

from __future__ import annotations

from bot_console.tui.console.model import ConsoleSnapshot

LEFT_SHOWN_S = 30.0
"""Seconds for which the pane says that a node has left."""


class Absences:
    """Follows snapshots; times are those of a monotonic clock (s)."""

    def __init__(self) -> None:
        self._left: dict[str, float] = {}
        """Nodes that have left, and when."""
        self.reported = ""
        """The text that is on the screen."""

    def note(self, before: ConsoleSnapshot, snapshot: ConsoleSnapshot, now: float) -> None:
        """Note the nodes whose parameters are gone."""
        if before.parameters is not snapshot.parameters:
            for name in before.parameters.keys() - snapshot.parameters.keys():
                self._left[name] = now

    def text(self, snapshot: ConsoleSnapshot, now: float) -> str:
        """Which nodes have left lately, and which do not answer; empty if none."""
        trees, graph = snapshot.parameters, snapshot.graph
        self._left = {name: at for name, at in self._left.items() if now - at < LEFT_SHOWN_S and name not in trees}
        silent = trees.keys() & {*graph.silent, *(name for name, _ in graph.frozen)}
        parts = ((self._left.keys(), "has left", "have left"), (silent, "does not answer", "do not answer"))
        return "  ".join(
            f"⚠ {min(names)} {one}" if len(names) == 1 else f"⚠ {len(names)} nodes {many}"
            for names, one, many in parts
            if names
        )
