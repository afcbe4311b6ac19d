"""Texts of the parameter pane about nodes that have left, or that are in the graph but do not answer."""

from __future__ import annotations

from collections.abc import Mapping

from bot_console.tui.console.model import ConsoleSnapshot, ParameterTree
from bot_console.tui.text.endings import endings_of_nodes
from bot_console.tui.text.natural import natural_key

LEFT_SHOWN_S = 30.0
"""Seconds for which the pane says that a node has left."""


class Absences:
    """Tracks the nodes that have left or do not answer, by a monotonic clock (s)."""

    def __init__(self) -> None:
        self._left: dict[str, float] = {}
        """The nodes that have left, and when."""
        self._of: Mapping[str, ParameterTree] = {}
        self._trees: Mapping[str, ParameterTree] = {}
        self._endings: Mapping[str, str] = {}
        """How the processes of nodes without parameters ended."""
        self.reported = ""
        """The text that is shown."""

    def trees(self, snapshot: ConsoleSnapshot, now: int) -> Mapping[str, ParameterTree]:
        """The parameters of all nodes, also of nodes whose process has ended; `now` is in ns since the epoch.

        Returns the same object while nothing changes.
        """
        found = endings_of_nodes(snapshot.launch.processes, now) if snapshot.launch.processes else {}
        endings = {name: text for name, text in found.items() if name not in snapshot.parameters}
        if snapshot.parameters is not self._of or endings != self._endings:
            self._of, self._endings = snapshot.parameters, endings
            gone = {name: ParameterTree(name, ended=text) for name, text in endings.items()}
            together = {**snapshot.parameters, **gone}
            self._trees = dict(sorted(together.items(), key=lambda each: natural_key(each[0]))) if gone else self._of
        return self._trees

    def note(self, before: ConsoleSnapshot, snapshot: ConsoleSnapshot, now: float) -> None:
        """Record the nodes whose parameters are gone, unless the link is silent and they may still be running."""
        if before.parameters is not snapshot.parameters and not snapshot.link.silent_s:
            for name in before.parameters.keys() - snapshot.parameters.keys():
                self._left[name] = now

    def text(self, snapshot: ConsoleSnapshot, now: float) -> str:
        """Describe the nodes that left recently or do not answer; empty if there are none or the link is silent."""
        if snapshot.link.silent_s:
            return ""
        trees, graph = snapshot.parameters, snapshot.graph
        self._left = {name: at for name, at in self._left.items() if now - at < LEFT_SHOWN_S and name not in trees}
        debugged = trees.keys() & {name for name, _ in graph.debugged}
        silent = trees.keys() & {*graph.silent, *(name for name, _ in graph.frozen)} - debugged
        left = self._left.keys() - self._endings.keys()  # the others have rows that say how they ended
        parts = (
            (left, "has left", "have left"),
            (silent, "does not answer", "do not answer"),
            (debugged, "is stopped in debugger", "are stopped in debugger"),
        )
        return "  ".join(
            f"⚠ {min(names)} {one}" if len(names) == 1 else f"⚠ {len(names)} nodes {many}"
            for names, one, many in parts
            if names
        )
