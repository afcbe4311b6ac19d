"""The change journal: every parameter change and refusal with its source; and undo and redo, which are based on it."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bot_console.tui.console.model import Change, ChangeSource, JournalState, Value, same
from bot_console.tui.console.parameters.unsaved import UnsavedValues
from bot_console.tui.text.counted import counted
from bot_console.tui.text.value_text import value_text

if TYPE_CHECKING:
    from bot_console.tui.console.parameters.history_file import History

OURS = (ChangeSource.EDIT, ChangeSource.PROFILE, ChangeSource.FILE, ChangeSource.HISTORY)


@dataclass(frozen=True, slots=True)
class Move:
    """The old and new values of parameters that were set together on one node."""

    node: str
    before: Mapping[str, Value]
    after: Mapping[str, Value]

    def values(self, source: ChangeSource) -> Mapping[str, Value]:
        """The values that undoing or redoing the move sets."""
        return self.before if source is ChangeSource.UNDO else self.after


@dataclass(frozen=True, slots=True)
class Step:
    """One step of undo: an edit of one node, or values set on several nodes such as those of a profile."""

    moves: tuple[Move, ...]
    profiles: tuple[str, str] | None = None
    """The active profile before and after the step, if it changed."""

    def changes(self, source: ChangeSource, value: Callable[[str, str], Value]) -> bool:
        """Whether undoing or redoing the step changes anything; `value` returns the value of a node's parameter."""
        wanted = ((move.node, name, new) for move in self.moves for name, new in move.values(source).items())
        return bool(self.profiles) or any(not same(value(node, name), new) for node, name, new in wanted)

    def text(self, source: ChangeSource) -> str:
        """What undoing or redoing the step sets: the values, or their number if the step spans several nodes."""
        if len(self.moves) == 1:
            (move,) = self.moves
            values = (f"{name} = {value_text(value)}" for name, value in move.values(source).items())
            return f"{move.node} {', '.join(values)}"
        count = sum(len(each.after) for each in self.moves)
        name = f"profile {self.profiles[1]}, " if self.profiles else ""
        return f"{name}{counted(count, 'value')} of {counted(len(self.moves), 'node')}"

    def is_followed_by(self, other: Step) -> bool:
        """Whether another step changes the same parameters and starts with the values with which this one ends."""
        if len(self.moves) != 1 or len(other.moves) != 1 or self.moves[0].node != other.moves[0].node:
            return False
        ends, begins = self.moves[0].after, other.moves[0].before
        return ends.keys() == begins.keys() and all(same(ends[name], begins[name]) for name in ends)

    def overwritten(self, value: Callable[[str, str], Value]) -> str:
        """The end of a message that lists which values set by others an undo or redo overwrites; empty if none."""
        found: list[str] = []
        for move in self.moves:
            for name in move.after:
                now = value(move.node, name)
                if not same(now, move.before[name]) and not same(now, move.after[name]):
                    found.append(f"{move.node} {name} = {value_text(now)}")
        return f"; what another program had set meanwhile is overwritten: {', '.join(found)}" if found else ""


MAX_EARLIER_CHANGES = 5_000
"""The number of changes of earlier runs that are shown."""


class Journal:
    """A bounded list of changes numbered from 0, with the steps that can be undone and redone.

    With a history, every change is kept for later runs, and the changes of earlier runs come before number 0.
    """

    def __init__(self, capacity: int = 10_000, history: History | None = None) -> None:
        self._history = history
        self._history_problem = ""
        self._earlier = self._read_history()
        self._changes: deque[Change] = deque(maxlen=capacity)
        self._end = 0
        self._undo: deque[Step] = deque(maxlen=1_000)
        self._redo: list[Step] = []
        self._unsaved = UnsavedValues()
        self._lock = threading.Lock()
        self._state = JournalState(problem=self._problem)

    def _read_history(self) -> Sequence[Change]:
        try:
            return self._history.earlier(MAX_EARLIER_CHANGES) if self._history else ()
        except Exception as error:
            self._give_up_history(error)
            return ()

    def _give_up_history(self, error: Exception) -> None:
        """Continue without the history: an error in it must not end anything else, least of all a stop."""
        self._history = None
        self._history_problem = f"changes are not kept: {type(error).__name__}: {error}"

    @property
    def _problem(self) -> str:
        return self._history_problem or (self._history.problem if self._history else "")

    @property
    def state(self) -> JournalState:
        """The state of the journal; the same object until it changes."""
        return self._state

    def record(
        self,
        stamp: int,
        node: str,
        name: str,
        values: tuple[Value, Value],
        source: ChangeSource,
        refusal: str = "",
        by: str = "",
        *,
        answered: bool = True,
    ) -> None:
        """Add an entry; `values` are the old and new one, `refusal` the reason if it was refused or not answered.

        The entry is queued for the disk before it becomes visible. To be called by one thread at a time.
        """
        old, new = values
        change = Change(self._end, stamp, node, name, old, new, source, not refusal, refusal, by, answered=answered)
        if self._history:
            try:
                self._history.add(change)  # outside the lock, so that readers do not wait for the disk
            except Exception as error:
                self._give_up_history(error)
        with self._lock:
            self._changes.append(change)
            self._end += 1
            self._update_state()

    def did(self, step: Step, source: ChangeSource, *, continues: bool = False) -> None:
        """Add an accepted step of this console, so that it can be undone.

        A step that `continues` the last one is undone together with it, unless something else has come in between.
        """
        with self._lock:
            for move in step.moves:
                self._unsaved.moved(move.node, move.before, move.after, source)
            if source in OURS:
                if continues and self._undo and not self._redo and self._undo[-1].is_followed_by(step):
                    (first,), (last,) = self._undo.pop().moves, step.moves
                    step = Step((Move(first.node, first.before, last.after),))
                self._undo.append(step)
                self._redo.clear()
            elif source is ChangeSource.UNDO:
                self._redo.append(step)
            elif source is ChangeSource.REDO:
                self._undo.append(step)
            self._update_state()

    def take_undo(self) -> Step | None:
        """Remove and return the step to undo next; return it with `did` or `put_back`."""
        with self._lock:
            step = self._undo.pop() if self._undo else None
            self._update_state()
            return step

    def take_redo(self) -> Step | None:
        """Remove and return the step to redo next; return it with `did` or `put_back`."""
        with self._lock:
            step = self._redo.pop() if self._redo else None
            self._update_state()
            return step

    def put_back(self, step: Step, source: ChangeSource) -> None:
        """Return a step whose undo or redo was refused."""
        with self._lock:
            (self._undo if source is ChangeSource.UNDO else self._redo).append(step)
            self._update_state()

    def saved(self, nodes: Collection[str]) -> None:
        """Record that the values of some nodes, or of all if none is named, are now in a file."""
        with self._lock:
            self._unsaved.saved(nodes)
            self._update_state()

    def restarted(self, node: str, name: str) -> None:
        """Record that a node has restarted with another value: the earlier sets can no longer be undone or lost."""
        with self._lock:
            for steps in (self._undo, self._redo):
                left = [each for each in (_without(step, node, name) for step in steps) if each.moves]
                steps.clear()
                steps.extend(left)
            self._unsaved.restarted(node, name)
            self._update_state()

    def after(self, seq: int) -> Sequence[Change]:
        """The entries from number `seq` on, oldest first; a number below 0 includes those of earlier runs."""
        with self._lock:
            first = self._end - len(self._changes)
            here = list(self._changes)[max(0, seq - first) :]
        return here if seq >= 0 else [*self._earlier[seq:], *here]

    def close(self) -> None:
        """Close the history."""
        if self._history:
            self._history.close()

    def _update_state(self) -> None:
        first = self._end - len(self._changes)
        undoes, redoes = (_keys(steps[-1]) if steps else () for steps in (self._undo, self._redo))
        self._state = JournalState(first, self._end, self._unsaved.names, self._problem, undoes, redoes)


def _keys(step: Step) -> tuple[tuple[str, str], ...]:
    """Node and name of each parameter of a step."""
    return tuple((move.node, name) for move in step.moves for name in move.after)


def _without(step: Step, node: str, name: str) -> Step:
    """A copy of the step without one parameter."""
    if not any(each.node == node and name in each.after for each in step.moves):
        return step
    moves = [
        Move(each.node, _without_name(each.before, name), _without_name(each.after, name))
        if each.node == node
        else each
        for each in step.moves
    ]
    return replace(step, moves=tuple(each for each in moves if each.after))


def _without_name(values: Mapping[str, Value], name: str) -> Mapping[str, Value]:
    return {key: value for key, value in values.items() if key != name}
