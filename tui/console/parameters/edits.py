"""The edits of a person: staged, sent and refused values, and values that are in no file.

This is a view model: the parameters pane displays it and passes keys on to it. It knows no widget.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from functools import partial

from bot_console.tui.console.model import (
    RESTARTED,
    ChangeSource,
    JournalState,
    ParameterInfo,
    ParameterTree,
    SetOutcome,
    Value,
    parameter_in,
    same,
)
from bot_console.tui.console.parameters.pending_sets import PendingSets
from bot_console.tui.console.parameters.port import Parameters
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.console.parameters.staging import SETS, Key, Staging, by_node

Outcomes = Sequence[SetOutcome]
Later = Callable[..., object]
"""Calls a function with arguments in the drawing thread; may be called from any thread."""


BURST_S = 1.0
"""Another step of the same value within this time (s) belongs to the same burst, which one undo reverts."""


class ParameterEdits:
    """Sends or stages edits, and keeps their outcomes; used only by the drawing thread."""

    def __init__(
        self,
        parameters: Parameters,
        trees: Callable[[], Mapping[str, ParameterTree]],
        later: Later,
        changed: Callable[[], object],
        failed: Callable[[str, Outcomes], object],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`trees` returns the current parameters of all nodes. `changed` is called when there is something to draw.

        `failed` is called with the outcomes when values that were sent together were not all accepted, and with the
        reason when values could not be sent.
        """
        self._parameters = parameters
        self._trees = trees
        self._later = later
        self._changed = changed
        self._failed = failed
        self.clock = clock
        self.staging = Staging()
        self.refused: dict[Key, SetOutcome] = {}
        """The refusals that have not been dismissed, by node and parameter."""
        self.unsaved: frozenset[Key] = frozenset()
        """Values that are in no file."""
        self.moved: frozenset[Key] = frozenset()
        """Values that differ from those at the start."""
        self.late: Mapping[Key, Value] = {}
        """Values that have been sent for some time and are still unanswered."""
        self._pending = PendingSets()
        self._stepped: tuple[Key, float] | None = None
        """The value that was stepped last, and when; None if there has been another edit since."""
        self._kept_continues: dict[Key, bool] = {}
        """Whether a value that waits for the answer to an earlier one continues the burst of that one."""
        self._starts: dict[Key, Value] = {}
        """The values before their first change in this run."""
        self._read = 0
        """Changes with numbers below this one have been processed."""

    def observe(self, journal: JournalState) -> bool:
        """Update `unsaved` and `moved` from a changed journal; returns whether they have changed."""
        for each in self._parameters.changes(self._read):
            self._read = max(self._read, each.seq + 1)
            if each.accepted and each.by == RESTARTED:
                self._starts[each.node, each.name] = each.new
            elif each.accepted:
                self._starts.setdefault((each.node, each.name), each.old)
        before = self.unsaved, self.moved
        self.unsaved = frozenset(journal.unsaved)
        self.moved = frozenset(
            key
            for key, start in self._starts.items()
            if (parameter := self._parameter(key)) is not None and not same(parameter.value, start)
        )
        return (self.unsaved, self.moved) != before

    def value_changed(self, key: Key) -> None:
        """Forget an earlier refusal of a value, because the value has changed."""
        self.refused.pop(key, None)

    def poll(self) -> bool:
        """Update `late`; returns whether it has changed. To be called ten times a second."""
        before, self.late = self.late, self._pending.late(self.clock())
        return self.late != before

    def _parameter(self, key: Key) -> ParameterInfo | None:
        return parameter_in(self._trees(), *key)

    def now(self, parameter: ParameterInfo) -> Value:
        """The value from which a step starts: the staged one, else the one that was sent, else the current one."""
        key = (parameter.node, parameter.name)
        if key in self.staging.marked:
            return self.staging.marked[key]
        return self._pending.value(key, parameter.value, self.clock())

    def set(self, parameter: ParameterInfo, value: Value) -> None:
        """Stage or send a value. While an earlier value is unanswered, only the newest one waits."""
        self._stepped = None
        self._set(parameter, value, continues=False)

    def step(self, parameter: ParameterInfo, value: Value) -> None:
        """Stage or send a value as `set` does; steps in quick succession form a burst that is undone as a whole."""
        before, now = self._stepped, self.clock()
        key = (parameter.node, parameter.name)
        self._stepped = key, now
        self._set(parameter, value, continues=before is not None and before[0] == key and now - before[1] < BURST_S)

    def _set(self, parameter: ParameterInfo, value: Value, *, continues: bool) -> None:
        key = (parameter.node, parameter.name)
        if self.staging.marking:
            self.staging.mark(key, parameter.value, value)
            self.refused.pop(key, None)  # the refusal of an earlier value would hide this one
            self._changed()
        elif self._pending.keep(key, value):
            self._kept_continues[key] = continues and self._kept_continues.get(key, True)
        else:
            self._send(key, value, continues=continues)

    def _send(self, key: Key, value: Value, *, continues: bool) -> None:
        answer = self._parameters.set(key[0], {key[1]: value}, ChangeSource.EDIT, continues=continues)
        number = self._pending.sent({key: value}, self.clock())
        answer.add_done_callback(partial(self._later, self._on_answer, number, key, value))

    def _on_answer(self, number: int, key: Key, value: Value, done: Future[tuple[SetOutcome, ...]]) -> None:
        accepted, newest = self._process_outcomes(number, done), self._pending.take(key)
        continues = self._kept_continues.pop(key, False)
        if not accepted:
            self._stepped = None
        elif newest is not None and not same(newest, value):
            self._send(key, newest, continues=continues)
        self._changed()

    def dismiss(self, key: Key) -> bool:
        """Dismiss a refusal; returns whether there was one."""
        found = self.refused.pop(key, None) is not None
        if found:
            self._changed()
        return found

    def unstage(self, key: Key) -> None:
        """Drop a staged value."""
        if self.staging.marked.pop(key, None) is not None:
            self._changed()

    def stage(self) -> None:
        """Switch between staging edits and sending them."""
        self.staging.marking = not self.staging.marking
        self._changed()

    def risks(self, values: Mapping[Key, Value]) -> list[tuple[ParameterInfo, Value, str]]:
        """The values that would make the robot less safe: parameter, value, and in what way."""
        found = [(self._parameter(key), value) for key, value in values.items()]
        known = [(parameter, value) for parameter, value in found if parameter is not None]
        return [(each, value, why) for each, value in known if (why := takes_safety(each, each.value, value))]

    def apply(self, values: Mapping[Key, Value]) -> None:
        """Send values together: either all of them are accepted, or none."""
        # Not when the answer arrives: someone who stages a value in the meantime wants to continue staging.
        self.staging.marking = bool(self.staging.marked.keys() - values.keys())
        self._send_all(values, "", partial(self._on_applied, values))

    def _on_applied(self, values: Mapping[Key, Value], accepted: bool) -> None:
        marked = self.staging.marked
        if accepted:
            self.staging.marked = {key: value for key, value in marked.items() if values.get(key) != value}
        else:
            self.staging.marking = bool(marked)

    def begin_sets(self, values: Mapping[Key, Value]) -> None:
        """Make set A of the current values and set B of the staged ones, and send B."""
        self.staging.begin(dict(values), self._trees())
        self._changed()
        self.swap()

    def swap(self) -> None:
        """Send the set that is not live."""
        self._send_all(self.staging.other, SETS[1 - self.staging.live], self._on_swapped)

    def _on_swapped(self, accepted: bool) -> None:
        if accepted:
            self.staging.live = 1 - self.staging.live

    def _send_all(self, values: Mapping[Key, Value], by: str, then: Callable[[bool], None]) -> None:
        answer = self._parameters.set_all(by_node(values), by=by)
        number = self._pending.sent(values, self.clock())
        answer.add_done_callback(partial(self._later, self._answered_all, number, then))

    def _answered_all(self, number: int, then: Callable[[bool], None], done: Future[tuple[SetOutcome, ...]]) -> None:
        accepted = self._process_outcomes(number, done)
        then(accepted)
        if not (accepted or done.exception()):
            self._failed("", done.result())
        self._changed()

    def _process_outcomes(self, number: int, done: Future[tuple[SetOutcome, ...]]) -> bool:
        """Keep the refusals, and drop those of values that are accepted now; returns whether all were accepted."""
        error = done.exception()
        outcomes = () if error else done.result()
        accepted = {(each.node, each.name): each.value for each in outcomes if each.accepted}
        self._pending.answered(number, accepted, self.clock())
        if error is not None:
            self._failed(str(error), ())
            return False
        for each in outcomes:
            if each.accepted:
                self.refused.pop((each.node, each.name), None)
            else:
                self.refused[each.node, each.name] = each
        return all(each.accepted for each in outcomes)
