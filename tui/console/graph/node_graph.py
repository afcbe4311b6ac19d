"""The port for the graph, which a `GraphWatch` polls once the system is reached."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from typing import TYPE_CHECKING

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.model import GraphInfo, LaunchInfo, ParameterTree
from bot_console.tui.files.save_file import NotSaved, typed_path

if TYPE_CHECKING:
    from bot_console.tui.console.graph.lifecycle import LifecycleWatch
    from bot_console.tui.console.graph.watch import GraphWatch

NO_GRAPH = GraphInfo()


class NodeGraph:
    """The port for the graph: what is known of it, and the requests that concern it."""

    _watch: GraphWatch | None = None
    _lifecycle: LifecycleWatch
    """Exists after `attach`."""

    def __init__(
        self,
        gate: Gate,
        launch: Callable[[], LaunchInfo],
        trees: Callable[[], Mapping[str, ParameterTree]],
        processes: Callable[[], Mapping[int, Sequence[str]]],
        logged: Callable[[], int],
        complaint: Callable[[str, int], str],
    ) -> None:
        """`processes` returns the nodes of the programs on this machine, by pid. `logged` returns the number of the
        next log record, and `complaint` the last warning or error that a node has logged since the record with a given
        number.
        """
        self._logged, self._complaint = logged, complaint
        self._gate = gate
        self._launch, self._trees, self._processes = launch, trees, processes
        self._requesters: frozenset[str] = frozenset()

    def attach(self, watch: GraphWatch, lifecycle: LifecycleWatch) -> None:
        """Provide what exists once the system has been reached."""
        self._watch, self._lifecycle = watch, lifecycle

    @property
    def info(self) -> GraphInfo:
        """The graph; the same object until it changes."""
        return self._watch.info if self._watch else NO_GRAPH

    def write_launch(self, path: str) -> Answer:
        """Write a launch file and a parameter file."""
        from bot_console.tui.console.launch.launch_writer import RunningSystem, write_launch

        if self._gate.unreached:
            return Answer(False, self._gate.unreached)
        try:
            system = RunningSystem(self.info, self._launch(), self._trees(), self._processes())
            return Answer(True, write_launch(typed_path(path), system).text)
        except NotSaved as error:
            return Answer(False, f"not saved: {error}")

    def change_state(self, node: str, transition: str) -> Future[Answer]:
        """Request a transition of a lifecycle node."""
        return self._gate.run(lambda: self._change_state(node, transition), partial(Answer, False))

    async def _change_state(self, node: str, transition: str) -> Answer:
        since = self._logged()
        answer = await self._lifecycle.change(node, transition)
        why = "" if answer.ok else self._complaint(node, since)
        return Answer(answer.ok, f"{answer.text}: {why}" if why else answer.text)

    def watch_nodes(self, on: bool, requester: str) -> None:
        """Check which nodes respond while any requester wants it, once the system is reached."""
        self._requesters = self._requesters - {requester} | ({requester} if on else set[str]())

        def watch() -> None:
            if self._watch is not None:
                self._watch.watch_nodes(bool(self._requesters))

        self._gate.run_when_open(watch)
