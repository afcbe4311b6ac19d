"""Parameter changes: who requested them, how they ended, and the journal of all of them."""

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
"""`Change.by` of a value that nobody has set: its node has restarted with another value than before."""


@dataclass(frozen=True, slots=True)
class SetOutcome:
    """The outcome of setting one parameter.

    `refused_by` is `console` (it could not even be sent), `descriptor` (range, type, read-only), `callback` (the node's
    own rule), `node` (no answer, or it has no such parameter) or empty when the value was accepted.
    """

    node: str
    name: str
    value: Value
    accepted: bool
    reason: str = ""
    refused_by: str = ""


@dataclass(frozen=True, slots=True)
class Change:
    """A journal entry: a parameter that changed, or a change that was refused."""

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
    """The operation it was part of: the name of a profile or a file."""
    run: int = 0
    """The run in which it was recorded, by its start (ns since the epoch); 0 is the current run."""
    answered: bool = True
    """False if it was not set because its node did not answer, or lacks the parameter, rather than refused."""


@dataclass(frozen=True, slots=True)
class JournalState:
    """The change journal as a whole: changes `first` to `end` - 1 are kept, and what can be undone and redone.

    Changes of earlier runs have negative numbers.
    """

    first: int = 0
    end: int = 0
    unsaved: tuple[tuple[str, str], ...] = ()
    """Node and name of each value that was set from this console and is in no file, so that it would be lost."""
    problem: str = ""
    """Why changes are not kept for later runs; empty if they are, or if that was not requested."""
    undoes: tuple[tuple[str, str], ...] = ()
    """Node and name of each value that the next undo takes back; empty if there is nothing to undo."""
    redoes: tuple[tuple[str, str], ...] = ()
    """The same for the next redo."""
