"""The history pane: every parameter change and refusal, of this run and earlier ones; changes can be reverted."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    JournalState,
    SetOutcome,
    Value,
    parameter_in,
)
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.panes.history.effect import Effects
from bot_console.tui.panes.history.export import FORMS, export
from bot_console.tui.panes.history.revert import Restoration, restorations, values_at
from bot_console.tui.panes.history.rows import ChangeRows, day_text, details, param_set_line, searched_text, set_details
from bot_console.tui.panes.history.sets import ChangeSet, changes_of, group_changes
from bot_console.tui.panes.history.strip import time_strip
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.text.counted import counted
from bot_console.tui.text.refusals import of_many
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.picture import Picture
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Confirmation
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text
from textual.app import ComposeResult

ALL = -(10**9)
"""A sequence number before the first change of all runs."""
MAX_NAMED_VALUES = 12
"""Maximum number of values that a question lists."""

EMPTY = Placeholder(
    "Every parameter change is listed here, whoever made it, and can be undone.",
    (("1", "Change a parameter"), ("7", "Apply a profile"), ("?", "Help")),
)


class HistoryPane(ListPane):
    """Changes of parameters, the newest first."""

    TITLE = "History"
    HELP = (
        "Every change of a parameter and every refusal, whoever made it, the newest first; earlier runs follow below\n"
        "with their dates. Changes made together, for example by a profile, are one row that Enter opens; the line\n"
        "at the top shows the rows of one run over time. u goes back to a row: after a question, every value changed\n"
        "after it returns to what it was then, all or nothing. Log and plot show the moment of the row at the\n"
        "cursor; Escape returns to now. Each change also shows how the robot's speed changed in the seconds after it."
    )
    BINDINGS = keymap.bindings("history")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s), replaced in tests."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._journal = JournalState()
        self._every: list[Change] = []
        self._only_refused = False
        self._problem = ""
        self._effects = Effects()
        self._seen: int | None = None
        """The end of the journal in the last snapshot; None before the first one."""
        self._opened: set[tuple[str, int]] = set()
        """The keys of the sets whose changes are listed."""

    def compose(self) -> ComposeResult:
        """A timeline, the changes, details of the one at the cursor, and a prompt."""
        yield Picture(id="history-strip")
        yield ChangeRows(self._effects.of)
        yield StaticText(id="history-detail")
        yield Prompt(id="history-prompt")

    @property
    def _list(self) -> ChangeRows:
        return self.query_one(ChangeRows)

    def focus_target(self) -> None:
        """Focus the list of changes."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Update the list if the journal has changed."""
        problem, self._problem = self._problem, snapshot.problem
        if snapshot.journal is not self._journal or snapshot.problem != problem:
            new = snapshot.journal
            if not self._every or new.end != self._journal.end or new.first != self._journal.first:
                self._every = [*self.console.parameters.changes(ALL)]
            self._journal = new
            self._arrange()

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Track the robot's speed before and after changes, even while hidden."""
        now, actual, end = self.clock(), snapshot.drive.actual, snapshot.journal.end
        is_news = self._effects.observe(None if actual is None else actual[0], now)
        if self._seen is not None and end > self._seen:
            new = [each.seq for each in self.console.parameters.changes(self._seen) if each.accepted]
            if new:
                self._effects.changed(new, now)
        self._seen = end
        if is_news and self.has_parts and self.display:
            self._list.refresh()
            self._describe()

    def _arrange(self) -> None:
        """Show the changes that pass the filter."""
        shown = [each for each in reversed(self._every) if self._wanted(each)]
        self._list.exchange(group_changes(shown, self._opened, self._is_unsafe))
        more = ("refused" if self._only_refused else "", self._journal.problem)
        self.report_filter(len(shown), len(self._every), *more)
        self._describe()

    def _wanted(self, change: Change) -> bool:
        if self._only_refused and change.accepted:
            return False
        return not self._query.terms or self._query.matches(searched_text(change), change.node)

    def _is_unsafe(self, change: Change) -> bool:
        parameter = parameter_in(self.console.snapshot().parameters, change.node, change.name)
        return parameter is not None and change.accepted and bool(takes_safety(parameter, change.old, change.new))

    def _describe(self) -> None:
        row = self._list.current
        self._list.show_placeholder(FILTERED_OUT if self.words or self._only_refused else EMPTY)
        strip = self.query_one("#history-strip", Picture)
        line = time_strip(self._list.rows, row, self.size.width)
        strip.display = bool(line)
        strip.set_lines((line,))
        if isinstance(row, ChangeSet):
            text = set_details(row)
        else:
            text = details(row, self._effects.of(row.seq)) if row is not None else Text(sanitize(self._problem), "dim")
        self.query_one("#history-detail", StaticText).show_or_hide(text)

    def on_resize(self) -> None:
        """Draw the timeline for the new width."""
        self._describe()

    @property
    def _current(self) -> Change | None:
        """The change at the cursor; for a set, its newest change."""
        row = self._list.current
        return row.newest if isinstance(row, ChangeSet) else row

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the change at the cursor, and move the time cursor to it."""
        event.stop()
        self._describe()
        change = self._current
        if change is not None and self._list.has_focus:
            self.time_cursor.move(change.stamp, self)

    def time_moved(self, stamp: int | None) -> None:
        """Go to the last change before the moment to which another pane has moved the time cursor."""
        if stamp is None or self.is_ending:
            return
        before = (index for index, each in enumerate(self._list.rows) if each.stamp <= stamp)
        at = next(before, None)
        if at is not None:
            self._list.cursor = at

    def action_clear_filter(self) -> None:
        """Return the time cursor to now; if it is there already, show all changes."""
        if self.time_cursor.stamp is not None:
            self.time_cursor.move(None, self)
        else:
            self._only_refused = False
            self.set_filter("")

    def action_refused(self) -> None:
        """Switch between showing refusals only and all changes."""
        self._only_refused = not self._only_refused
        self._arrange()

    def action_back(self) -> None:
        """Go back to the row at the cursor, after a question."""
        change = self._current
        if change is not None:
            moment = day_text(change.stamp)
            self._ask(values_at(self._every, change), f"Go back to {moment}, {change.node} {change.name}?")

    def action_open(self) -> None:
        """List or hide the changes of the set at the cursor."""
        row = self._list.current
        if isinstance(row, ChangeSet):
            self._fold(row, row.opened)

    def action_fold(self, closes: bool) -> None:
        """Open or close the set at the cursor, or the one that the change at the cursor is part of."""
        row, at = self._list.current, self._list.cursor
        if closes and isinstance(row, Change):
            above = (each for each in reversed(self._list.rows[:at]) if isinstance(each, ChangeSet))
            row = next((each for each in above if row in each.changes), None)
        if isinstance(row, ChangeSet):
            self._fold(row, closes)

    def _fold(self, row: ChangeSet, closes: bool) -> None:
        if closes == row.opened:
            self._opened ^= {row.key}
            self._arrange()
            self._list.cursor = next(at for at, each in enumerate(self._list.rows) if self._list.key(each) == row.key)

    def action_before(self) -> None:
        """Restore the value from before the change at the cursor, or the values from before a set, after a question."""
        row, change = self._list.current, self._current
        if change is None:
            return
        if isinstance(row, ChangeSet):
            # A set lists the newest change first, so the oldest value of each parameter wins.
            olds = {(each.node, each.name): each.old for each in row.changes if each.accepted and each.old is not None}
            self._ask(olds, f"Put {counted(len(olds), 'value')} back?")
            return
        if not change.accepted:
            self.notify(f"{change.name} was not set, so there is nothing to put back.")
        elif change.old is None:
            self.notify(f"{change.name} had no value before.")
        else:
            self._ask({(change.node, change.name): change.old}, f"Put {change.name} back?")

    def _ask(self, then: Mapping[tuple[str, str], Value], question: str) -> None:
        if not self.may_change():
            return
        trees = self.console.snapshot().parameters
        found, missing = restorations(then, trees)
        if not found:
            self.notify("; ".join(["The robot has these values already." if not missing else "", *missing]).strip("; "))
            return
        # Values that reduce safety come first, so that they are never among those left out.
        every = sorted((self._line(each) for each in found), key=lambda line: not line.startswith("⚠"))
        lines = every[:MAX_NAMED_VALUES]
        lines += (
            [f"... and {counted(len(found) - MAX_NAMED_VALUES, 'value')} more"] if len(found) > MAX_NAMED_VALUES else []
        )
        lines += [f"not set: {each}" for each in missing[:MAX_NAMED_VALUES]]
        self.ask(Confirmation(question, lambda _: self._go(found), reasons="\n".join(lines)))

    def _line(self, each: Restoration) -> str:
        parameter = parameter_in(self.console.snapshot().parameters, each.node, each.name)
        unsafe = takes_safety(parameter, each.now, each.then) if parameter else ""
        text = f"{each.node} {each.name}  {value_text(each.now)} → {value_text(each.then)}"
        return f"⚠ {text}: {unsafe}" if unsafe else f"  {text}"

    def _go(self, found: list[Restoration]) -> None:
        values: dict[str, dict[str, Value]] = {}
        for each in found:
            values.setdefault(each.node, {})[each.name] = each.then
        answer = self.console.parameters.set_all(values, ChangeSource.HISTORY)
        answer.add_done_callback(lambda done: self.host.call_later(self._outcome, done))

    def _outcome(self, done: Future[tuple[SetOutcome, ...]]) -> None:
        error = done.exception()
        if error is not None:
            self.notify(str(error), severity="error")
            return
        refused = of_many(done.result())
        if refused:
            self.notify(refused, severity="error")
        else:
            self.notify(f"{counted(len(done.result()), 'value')} put back; u in the Parameters pane undoes it.")

    def action_plot(self) -> None:
        """Plot the parameter at the cursor."""
        change = self._current
        if change is not None:
            self.post_message(self.PlotWanted(f"{change.node}:{change.name}"))

    def action_copy(self) -> None:
        """Copy the command that repeats the change to the clipboard, through the terminal (OSC 52)."""
        change = self._current
        if change is not None:
            row = self._list.current
            text = "\n".join(param_set_line(each, each.new) for each in reversed(changes_of(row))) if row else ""
            self.host.copy_to_clipboard(text)
            self.notify(text, title="Copied")

    def action_export(self) -> None:
        """Ask for the file to which the shown changes are exported."""
        self.ask_file(f"export to ({' '.join(FORMS)})", "history.csv", self._export)

    def _export(self, path: Path) -> Answer:
        shown = [each for each in self._every if self._wanted(each)]
        return Answer(True, f"{counted(export(path, shown), 'change')} exported to {path}")
