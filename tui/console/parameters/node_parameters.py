"""The port for parameters: passes edits through the gate to the nodes, and keeps the journal."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    GraphInfo,
    JournalState,
    ParameterTree,
    SetOutcome,
    Severity,
    Value,
)
from bot_console.tui.console.parameters.journal import Journal
from bot_console.tui.console.parameters.provenance import Provenance
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.files.save_file import NotSaved, typed_path
from bot_console.tui.text.value_text import value_text

if TYPE_CHECKING:
    from bot_console.tui.console.calls import Calls
    from bot_console.tui.console.launch.process_output import Add
    from bot_console.tui.console.parameters.history_file import History
    from bot_console.tui.console.parameters.mirror import ParameterMirror
    from bot_console.tui.console.parameters.setter import ParameterSetter
    from rclpy.node import Node

OnValue = Callable[[str, str, Value], None]
"""Receives a node, the name of a parameter, and its new value."""
NO_TREES: Mapping[str, ParameterTree] = MappingProxyType({})
NO_JOURNAL = JournalState()
LABEL = "bot-console"


class NodeParameters:
    """The parameters of all nodes. Methods may be called from any thread; the executor does the work."""

    _setter: ParameterSetter
    """Exists after `attach`; only requests that have passed the gate use it."""

    def __init__(self, gate: Gate, provenance: Provenance, on_value: OnValue | None = None) -> None:
        self._gate = gate
        self._provenance = provenance
        self._on_value = on_value
        self._log: Add | None = None
        self._journal: Journal | None = None
        self._mirror: ParameterMirror | None = None

    def attach(self, node: Node, calls: Calls, log: Add, history: History | None, active_profile: str) -> None:
        """Start reading the parameters of all nodes.

        `log` receives warnings about values that make the robot less safe; `history` keeps changes for later runs.
        """
        from bot_console.tui.console.parameters.mirror import ParameterMirror
        from bot_console.tui.console.parameters.setter import ParameterSetter

        self._log = log
        self._journal = Journal(history=history)
        self._mirror = ParameterMirror(node, calls, self._changed, self._provenance, self._restarted)
        self._setter = ParameterSetter(calls, self._mirror, self._journal)
        self._setter.profile = active_profile

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        if self._mirror is not None:
            self._mirror.follow(graph)

    @property
    def trees(self) -> Mapping[str, ParameterTree]:
        """The parameters by node; the same object until one changes."""
        return self._mirror.trees if self._mirror else NO_TREES

    @property
    def journal(self) -> JournalState:
        """The state of the journal; the same object until it changes."""
        return self._journal.state if self._journal else NO_JOURNAL

    @property
    def profile(self) -> str:
        """The profile that was applied last and not undone."""
        return self._setter.profile if self._mirror else ""

    def profile_renamed(self, name: str, to: str) -> None:
        """Rename the active profile, if that is the one that was renamed."""
        if self.profile == name:
            self._setter.profile = to

    def _changed(self, node: str, name: str, old: Value, new: Value) -> ChangeSource:
        if self._on_value is not None:
            self._on_value(node, name, new)
        source = self._setter.announced(node, name, old, new)
        self._warn_if_unsafe(node, name, old, new)
        return source

    def _restarted(self, node: str, name: str, old: Value, new: Value) -> None:
        if self._on_value is not None:
            self._on_value(node, name, new)
        self._setter.restarted(node, name, old, new)
        self._warn_if_unsafe(node, name, old, new)

    def _warn_if_unsafe(self, node: str, name: str, old: Value, new: Value) -> None:
        parameter = self._mirror.get(node, name) if self._mirror else None
        why = takes_safety(parameter, old, new) if parameter else ""
        if why and self._log is not None:
            text = f"{node} {name} {value_text(old)} -> {value_text(new)} {why}"
            self._log(time.time_ns(), Severity.WARN, LABEL, text, ("", "", 0))

    def learn(self, kind: str, facts: Mapping[str, Any]) -> None:
        """Process a fact that a program or a launch reports about itself; from any thread."""
        node, mirror = self._provenance.learn(kind, facts), self._mirror
        if mirror is not None and node in mirror.trees:
            self._gate.run(partial(mirror.refresh, node), lambda why: None, changes=False)

    def set(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
        continues: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of one node."""
        return self._gate.run(
            lambda: self._setter.set(node, values, source, atomically=atomically, continues=continues),
            partial(refused, {node: values}),
        )

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of several nodes: all or none."""
        return self._gate.run(lambda: self._setter.set_all(values, source, by), partial(refused, values))

    async def apply(self, profile: str, values: Mapping[str, Mapping[str, Value]]) -> tuple[SetOutcome, ...]:
        """Set a profile's values: all or none. A coroutine for the console's executor."""
        return await self._setter.apply(profile, values)

    def undo(self) -> Future[Answer]:
        """Revert the last change made by this console."""
        return self._gate.run(lambda: self._setter.move(ChangeSource.UNDO), partial(Answer, False))

    def redo(self) -> Future[Answer]:
        """Repeat the last undone change."""
        return self._gate.run(lambda: self._setter.move(ChangeSource.REDO), partial(Answer, False))

    def changes(self, after: int = 0) -> Sequence[Change]:
        """The journal entries from a number on."""
        return self._journal.after(after) if self._journal else ()

    def save(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write parameters to a file."""
        from bot_console.tui.console.parameters.file.saving import save

        if self._gate.unreached:
            return Answer(False, self._gate.unreached)
        try:
            place = typed_path(path)
            saved = save(place, self.trees, tuple(nodes), only_changed=only_changed)
        except NotSaved as error:
            return Answer(False, f"not saved: {error}")
        self.saved(nodes)
        return Answer(True, saved.text(place))

    def saved(self, nodes: Sequence[str] = ()) -> None:
        """Record that the values of some nodes, or of all if none is named, are now in a file."""
        if self._journal is not None:
            self._journal.saved(nodes)

    def close(self) -> None:
        """Close the history."""
        if self._journal is not None:
            self._journal.close()


def refused(values: Mapping[str, Mapping[str, Value]], why: str) -> tuple[SetOutcome, ...]:
    """The outcomes for values (by node and name) that could not even be sent."""
    return tuple(
        SetOutcome(node, name, value, False, why, "console")
        for node, found in values.items()
        for name, value in found.items()
    )
