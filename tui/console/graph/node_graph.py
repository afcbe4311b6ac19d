"""The port for the graph, which a `GraphWatch` polls once the system is reached."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.tui.console.gate import Gate
from bot_console.tui.console.model import GraphInfo

if TYPE_CHECKING:
    from bot_console.tui.console.graph.watch import GraphWatch

NO_GRAPH = GraphInfo()


class NodeGraph:
    """What is known of the graph."""

    _watch: GraphWatch | None = None

    def __init__(self, gate: Gate) -> None:
        self._gate = gate

    def attach(self, watch: GraphWatch) -> None:
        """The system has been reached."""
        self._watch = watch

    @property
    def info(self) -> GraphInfo:
        """The graph; the same object until it changes."""
        return self._watch.info if self._watch else NO_GRAPH

    def watch_nodes(self, on: bool) -> None:
        """Start or stop checking which nodes respond, as soon as the system is reached."""

        async def watch() -> None:
            if self._watch is not None:
                self._watch.watch_nodes(on)

        self._gate.when_open(lambda: self._gate.run(watch, lambda why: None, changes=False))
