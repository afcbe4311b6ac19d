"""The port for the parameters of all nodes. Standard library only.

The values are in `ConsoleSnapshot.parameters`, and the state of the journal is `ConsoleSnapshot.journal`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import Change, ChangeSource, SetOutcome, Value


class Parameters(Protocol):
    """Sets parameters, and keeps a journal of all changes."""

    def set(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
        continues: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of one node, by its `set_parameters` or `set_parameters_atomically` service.

        A set that `continues` the previous one of the same parameters is undone together with it.
        """
        ...

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of several nodes (by node and name): all or none. A single undo reverts all of them.

        `by` names the operation that they belong to. If one node refuses, nodes that had already accepted are set back,
        and every outcome says why; for a value that could not be set back, `accepted` is set and there is a reason.
        """
        ...

    def undo(self) -> Future[Answer]:
        """Restore the values from before the last accepted change of this console."""
        ...

    def redo(self) -> Future[Answer]:
        """Repeat the last undone change."""
        ...

    def changes(self, after: int = 0) -> Sequence[Change]:
        """The journal entries from number `after` on, oldest first; entries of earlier runs have negative numbers."""
        ...

    def save(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write a ROS parameter file; an existing file keeps its comments.

        With `only_changed`, write only the values that differ from the declared ones or, where those are unknown, from
        the start values.
        """
        ...
