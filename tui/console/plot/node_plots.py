"""The port for time series: fields of topics and parameters of the system, collected by a `PlotWatch`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.model import GraphInfo, ParameterTree, Value
from bot_console.tui.console.plot.port import Samples

if TYPE_CHECKING:
    from bot_console.tui.console.plot.watch import PlotWatch


class NodePlots:
    """Collects series. Plotting changes nothing in the system, so a read-only console can plot too."""

    def __init__(
        self, gate: Gate, graph: Callable[[], GraphInfo], trees: Callable[[], Mapping[str, ParameterTree]]
    ) -> None:
        self._gate = gate
        self._graph = graph
        self._trees = trees
        self._watch: PlotWatch | None = None

    def attach(self, watch: PlotWatch) -> None:
        """Provide the collector, once the system has been reached."""
        self._watch = watch

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        if self._watch is not None:
            self._watch.follow(graph)

    def record_parameter(self, node: str, name: str, value: Value) -> None:
        """Record a parameter's new value."""
        if self._watch is not None:
            self._watch.record_parameter(node, name, value)

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series."""
        if self._watch is None or self._gate.unreached:
            return Answer(False, self._gate.unreached)
        return self._watch.watch(path, self._graph(), self._trees(), requester)

    def unwatch(self, path: str, requester: str = "") -> None:
        """Stop collecting a series."""
        if self._watch is not None:
            self._watch.unwatch(path, requester)

    def samples(self, path: str, after: int = 0) -> Samples:
        """New samples of a series."""
        return self._watch.samples(path, after) if self._watch else Samples((), (), after)

    def time(self, stamp: int | None = None) -> float:
        """The position of a time on the axis; 0 before the system is reached."""
        return self._watch.axis_time(stamp) if self._watch else 0.0

    def plottable(self) -> Sequence[str]:
        """The paths that can be plotted."""
        return self._watch.plottable(self._graph(), self._trees()) if self._watch else ()
