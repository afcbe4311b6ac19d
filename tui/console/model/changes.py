"""Parameter changes: who requested them, how they ended, and the state of the journal."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from bot_console.tui.console.model.parameters import Value


class ChangeSource(str, Enum):
    """Who requested a parameter change."""

    EDIT = "edit"
    UNDO = "undo"
    REDO = "redo"
    PROFILE = "profile"
    FILE = "file"
    HISTORY = "history"
    ROLLBACK = "taken back"
    OTHER = "elsewhere"


RESTARTED = "the node came back with it"
"""The `Change.by` of a value that nobody has set: the node has restarted with another value than before."""


@dataclass(frozen=True, slots=True)
class SetOutcome:
    """The outcome of setting one parameter.

    `refused_by` is `console` (the value could not even be sent), `descriptor` (range, type, read-only), `callback` (the
    node's own rule), `node` (no answer, or no such parameter), or empty if the value was accepted.
    """

    node: str
    name: str
    value: Value
    accepted: bool
    reason: str = ""
    refused_by: str = ""


@dataclass(frozen=True, slots=True)
class Change:
    """A journal entry: a parameter that has changed, or a change that was refused."""

    seq: int
    stamp: int
    node: str
    name: str
    old: Value
    new: Value
    source: ChangeSource
    accepted: bool = True
    reason: str = ""
    by: str = ""
    """The operation that the change was part of: the name of a profile or a file."""
    run: int = 0
    """The run in which it was recorded, identified by its start (ns since the epoch); 0 is the current run."""
    answered: bool = True
    """False if it failed because the node did not answer or lacks the parameter, rather than being refused."""


@dataclass(frozen=True, slots=True)
class JournalState:
    """The state of the journal: it contains the changes `first` to `end` - 1, and some of them can be undone or redone.

    Changes of earlier runs have negative numbers.
    """

    first: int = 0
    end: int = 0
    unsaved: tuple[tuple[str, str], ...] = ()
    """Node and name of each value that was set from this console and is in no file, so that it might be lost."""
    problem: str = ""
    """Why changes are not kept for later runs; empty if they are, or if nobody asked for it."""
    undoes: tuple[tuple[str, str], ...] = ()
    """Node and name of each value that the next undo restores; empty if there is nothing to undo."""
    redoes: tuple[tuple[str, str], ...] = ()
    """The same for the next redo."""
