"""The parameter pane: all nodes' parameters as a tree, edited in place; a refusal stays in its row with its reason."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.model import ConsoleSnapshot, ParameterTree, same
from bot_console.tui.files.state_store import LAST_FILE
from bot_console.tui.format import command_of
from bot_console.tui.panes.parameters.absences import Absences
from bot_console.tui.panes.parameters.details import details
from bot_console.tui.panes.parameters.edit_pane import EditPane
from bot_console.tui.panes.parameters.rows import (
    Row,
    TreeRows,
    View,
    initial_folds,
    most_important_row,
    row_named,
    unfold_to,
)
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.panes.parameters.view_state import RowKey, ViewState, view_state_of
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Option, matching_options
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text
from textual.app import ComposeResult

WAITING = Placeholder(
    "The parameters of all nodes are shown here; waiting for nodes that have some.",
    (("8", "Start nodes"), ("7", "Profiles: values to start from"), ("?", "Help")),
)
COMPACT_LINES = 12
"""Minimum height (lines) at which the pane shows the whole tree; a lower one lists the parameters that matter most."""
STATE_NAME = "parameters"
MIN_DETAIL_LINES = 3
"""Lines of detail that every parameter has: its description, facts and command."""

FLASH_S = 1.0
"""Seconds for which a changed value is highlighted."""

SHARE = 3
"""The details take at most a third of the pane's height."""


class ParametersPane(EditPane):
    """Parameters of all nodes."""

    TITLE = "Parameters"
    HELP = (
        "Every node's parameters, live. Enter edits; + and - move a number by its step or a hundredth of its range.\n"
        "A value may be an expression with a unit: 0.5*2, 30 cm. A refused value snaps back; the row says who refused\n"
        "it and why. Marks: • differs from its declared (or start) value, ◦ changed since the start, * in no file,\n"
        "~ set by another program. m marks edits instead of sending them, a sends all or nothing, A swaps two sets."
    )
    BINDINGS = keymap.bindings("parameters")

    wall_clock: Callable[[], int] = staticmethod(time.time_ns)
    """Time in ns since the epoch; tests replace it with a clock that they step."""

    def __init__(self, *args: object, **kwargs: object) -> None:
        super().__init__(*args, **kwargs)  # type: ignore[arg-type] -- handed on as they are
        self._snapshot = ConsoleSnapshot()
        self._view = View()
        self._table = ParameterRows(self.edits)
        self._tree = TreeRows()
        self._expected = ""
        self._at_cursor: RowKey | None = None
        self._chosen = False
        """Whether the user has moved the cursor; until then it stays on the parameter that matters most."""

        self._folds_itself = True
        """Whether a large tree folds itself as nodes appear: until the user folds, unfolds or filters something."""
        self._absences = Absences()
        self._shown: Mapping[str, ParameterTree] = {}
        """The parameter trees from which the rows were made."""
        self._asking_by: object = None
        self._restored_row: RowKey | None = None
        """The row at the cursor at the end of the last run, until it reappears or the user moves the cursor."""

    def on_mount(self) -> None:
        """Restore folds, filter and cursor of the last run, unless a node was preselected."""
        left = view_state_of(self.state_store.get(STATE_NAME))
        if left is not None and not self._expected:
            self._restored_row = left.at
            self.words, self._view, self._table.split = left.words, left.view, left.split
            self._folds_itself = not (left.view.folded or left.view.filtering)
            self._sought = left.words
            self._arrange()

    def on_unmount(self) -> None:
        """Save folds, filter and cursor for the next run."""
        at = self._restored_row or self._at_cursor
        self.state_store.put(STATE_NAME, ViewState(self.words, self._view, at, self._table.split).data)

    def compose(self) -> ComposeResult:
        """The tree, details of the parameter at the cursor, and a prompt."""
        yield self._table
        yield StaticText(id="parameter-detail")
        yield Prompt(id="parameter-prompt")

    def focus_target(self) -> None:
        """Focus the tree."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Redraw the parameters if they are a different object."""
        before, self._snapshot = self._snapshot, snapshot
        self._absences.note(before, snapshot, self.edits.clock())
        if snapshot.journal is not before.journal and self.edits.observe(snapshot.journal):
            self._list.refresh()
            self._describe()
        if self._trees_now() is not self._shown or snapshot.problem != before.problem:
            self._arrange()

    def _trees_now(self) -> Mapping[str, ParameterTree]:
        """The parameters of all nodes, including nodes that have ended."""
        return self._absences.trees(self._snapshot, self.wall_clock())

    def _watch_nodes(self, on: bool) -> None:
        """Have nodes probed for liveness while the pane is visible."""
        wanted = self.console.graph if on else None
        if wanted is not self._asking_by:  # a different one, too, after a reconnection
            self._asking_by = wanted
            self.console.graph.watch_nodes(on, "parameters")

    def detach(self) -> None:
        """Stop probing."""
        self._watch_nodes(False)

    def tick(self) -> None:
        """End highlights that are over, and update what waits for an answer."""
        shown = self._table
        if not shown.is_attached:  # while the app exits and the screen is taken apart
            return
        self._watch_nodes(self.display)
        if self.display and self._trees_now() is not self._shown:
            self._arrange()
        if self._absences.text(self._snapshot, self.edits.clock()) != self._absences.reported:
            self._report_counts()
        if self.edits.poll():
            self.redraw_marks()
        if not shown.flashing:
            return
        over = {key for key, until in shown.flashing.items() if self.edits.clock() >= until}
        for key in over:
            del shown.flashing[key]
        for index, row in enumerate(shown.rows) if over else ():
            if row.parameter and (row.node, row.parameter.name) in over:
                shown.row_changed(index)

    def redraw_marks(self) -> None:
        """Redraw marks and refusals, and update the caption and the details."""
        self._list.refresh()
        self._report_counts()
        self._describe()

    def go_to(self, name: str) -> None:
        """Go to a node as soon as it exists; this overrides the folds and the filter restored from the last run."""
        self._expected = name
        if not self._chosen:
            self._restored_row, self.words, self._view = None, "", View()
        self._arrange()

    def _go_to_expected(self) -> None:
        shown = self._list
        found = next((index for index, row in enumerate(shown.rows) if row.node == self._expected), None)
        self.caption(f"waiting for {self._expected}" if found is None else "")
        if found is not None:
            self._expected, self._chosen = "", True
            shown.cursor = found

    def _arrange(self) -> None:
        """Make the rows, keep the cursor on its parameter, and draw what has changed."""
        shown, old = self._list, self._list.rows
        self._shown = self._trees_now()
        if self._folds_itself:
            self._fold_at_start()
        view = replace(self._view, essential=True) if self.has_class("compact") else self._view
        new = self._tree.rows(self._shown, view)
        if len(old) == len(new):
            for before, after in zip(old, new, strict=True):
                if before is not after:
                    self._value_changed(before, after)
        shown.exchange(new, stay=self._chosen)
        if not self._chosen:
            shown.begin_at(most_important_row(new))
        self._go_to_restored_row()
        self._report_counts()
        if self._expected and not view.essential:  # the short list has no rows of nodes
            self._go_to_expected()
        self._describe()

    def _fold_at_start(self) -> None:
        """Fold a large tree, except around the row where the cursor was and the node that is expected."""
        folded = initial_folds(self._shown)
        for node, name in (
            (self._restored_row[0], self._restored_row[1]) if self._restored_row else ("", ""),
            (self._expected, ""),
        ):
            folded = unfold_to(folded, node, name) if node else folded
        if folded != self._view.folded:
            self._view = replace(self._view, folded=folded)

    def _go_to_restored_row(self) -> None:
        rows = self._list.rows if self._restored_row else ()
        found = next((index for index, row in enumerate(rows) if self._list.key(row) == self._restored_row), None)
        if found is not None:
            self._restored_row, self._chosen = None, True
            self._list.cursor = found

    def _report_counts(self) -> None:
        found = sum(row.count for row in self._list.rows if row.depth == 0)  # each counts everything below it
        self._absences.reported = self._absences.text(self._snapshot, self.edits.clock())
        staged = "  ".join(filter(None, (self.edits.staging.caption(), sanitize(self._absences.reported))))
        if self._view.filtering:
            every = self._tree.count(self._shown, self._view)
            self.report_filter(found, every, *(each for each in ("changed" * self._view.only_changed, staged) if each))
        else:
            self.caption(staged)

    def _value_changed(self, before: Row, after: Row) -> None:
        if before.parameter is None or after.parameter is None or same(before.parameter.value, after.parameter.value):
            return
        key = (after.node, after.parameter.name)
        if key == (before.node, before.parameter.name):
            self.edits.value_changed(key)
            self._list.flashing[key] = self.edits.clock() + FLASH_S

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the parameter at the cursor."""
        event.stop()
        self._chosen = self._chosen or event.by_person
        self._restored_row = None if event.by_person else self._restored_row
        self._at_cursor = self._list.key_at_cursor
        self._describe()

    def on_resize(self) -> None:
        """In a low pane, list only the parameters that matter most, without the details."""
        compact = 0 < self.size.height < COMPACT_LINES
        if compact is not self.has_class("compact"):
            self.set_class(compact, "compact")
            self._arrange()
        self.call_after_refresh(self._describe)

    def _describe(self) -> None:
        """Describe the row at the cursor, in as many lines as that needs, up to a maximum."""
        self.keys_changed()
        self._list.show_placeholder(self._placeholder())
        words, text = self.query_one("#parameter-detail", StaticText), self._details(self._list.current)
        maximum = max(MIN_DETAIL_LINES, self.size.height // SHARE)
        width = words.size.width or self.content_size.width - 2  # it is hidden while there is nothing to say
        need = len(text.wrap(self.host.console, width)) if width > 0 else MIN_DETAIL_LINES
        height = min(max(need, MIN_DETAIL_LINES), maximum) + 1  # one is the line above
        if words.styles.height is None or words.styles.height.value != height:
            words.styles.height = height
        words.show_or_hide(text)

    def _placeholder(self) -> Placeholder:
        if self.words or self._view.only_changed:
            return FILTERED_OUT
        fixed = self._snapshot.capabilities.live
        return Placeholder(f"No parameters; {fixed}.") if fixed else WAITING

    def _details(self, row: Row | None) -> Text:
        if row is None:
            return Text(sanitize(self._snapshot.problem), "dim")
        if row.parameter is None:
            ended = f"{row.node} {row.problem}" if row.ended else ""
            return Text(sanitize(ended or row.problem or f"{row.node}  {counted(row.count, 'parameter')}"), "dim")
        key = (row.node, row.parameter.name)
        edits = self.edits
        marks = ["not saved"] if key in edits.unsaved else []
        marks += ["changed since the start"] if key in edits.moved else []
        staged, late = edits.staging.marked.get(key), edits.late.get(key)
        return details(row.parameter, edits.refused.get(key), staged, marks, late)

    def action_clear_filter(self) -> None:
        """Clear the filter; without one, dismiss the refusal at the cursor. Marked values stay marked."""
        if self.words or not self.dismiss_refusal():
            super().action_clear_filter()

    def action_undo(self) -> None:
        """Undo the last change made in this console."""
        self.report_later(self.console.parameters.undo())

    def action_redo(self) -> None:
        """Redo the change that was undone last."""
        self.report_later(self.console.parameters.redo())

    def apply_filter(self, words: str) -> None:
        """Show the parameters that pass the filter; the cursor goes to one whose name is the last word."""
        self._change_view(replace(self._view, query=parse(words), folded_matches=frozenset()))
        at = row_named(self._list.rows, words.rpartition(" ")[2], self._list.cursor)
        if at is not None:
            self._list.choose(at)

    def action_toggle_changed(self) -> None:
        """Switch between parameters that differ from their defaults and all parameters."""
        self._change_view(replace(self._view, only_changed=not self._view.only_changed, folded_matches=frozenset()))

    def _change_view(self, view: View) -> None:
        """Change the view; when a filter is cleared, unfold the parameter at the cursor so that it stays visible."""
        parameter = self._at()
        if parameter is not None and not view.filtering and self._view.filtering:
            view = replace(view, folded=unfold_to(view.folded, parameter.node, parameter.name))
        self._view, self._folds_itself = view, False
        self._arrange()

    def action_toggle_built_in(self) -> None:
        """Show or hide the built-in parameters."""
        self._view = replace(self._view, built_in=not self._view.built_in)
        self._arrange()

    def action_fold(self, closed: bool) -> None:
        """Fold or unfold the namespace, node or group at the cursor; folding anything else folds its parent."""
        shown = self._list
        row = shown.current
        if row is None or (not closed and not row.fold):
            return
        fold = row.fold
        if closed and (not fold or row.folded):
            above = (index for index in range(shown.cursor, -1, -1) if shown.rows[index].depth < row.depth)
            at = next(above, shown.cursor)
            fold = shown.rows[at].fold
            shown.choose(at)
        self._close(set(self._view.closed) - {fold} | ({fold} if closed else set[str]()))

    def _close(self, folded: Collection[str]) -> None:
        """Fold exactly these rows; the matches of a filter are folded independently of the unfiltered tree."""
        which = "folded_matches" if self._view.filtering else "folded"
        self._view, self._folds_itself = replace(self._view, **{which: frozenset(folded)}), False
        self._arrange()

    def action_fold_all(self) -> None:
        """Fold all nodes, or if any row is folded, unfold everything."""
        self._close(() if self._view.closed else self._snapshot.parameters)

    def action_split(self, cells: int) -> None:
        """Move the edge between names and values."""
        self._table.move_split(cells)

    def action_plot(self) -> None:
        """Plot the parameter at the cursor."""
        parameter = self._at()
        if parameter is not None:
            self.post_message(self.PlotWanted(f"{parameter.node}:{parameter.name}"))

    def action_copy(self) -> None:
        """Copy the command that sets this parameter, through the terminal (OSC 52)."""
        parameter = self._at()
        if parameter is not None:
            self._copy(command_of(parameter, parameter.value))

    def _copy(self, text: str) -> None:
        self.host.copy_to_clipboard(text)
        self.notify(text, title="Copied", markup=False)

    def action_copy_part(self) -> None:
        """Copy the name of the node at the cursor; for a parameter, ask whether to copy its name, value or node."""
        row = self._list.current
        if row is None:
            return
        if row.parameter is None:
            self._copy(row.node)
            return
        parts = {"name": row.parameter.name, "value": value_text(row.parameter.value), "node": row.node}

        def find(typed: str) -> list[Option]:
            return [Option(each, sanitize(text)) for each, text in parts.items() if typed.lower() in each]

        self.ask(Choice("Copy", lambda chosen: self._copy(parts[chosen]), find=find))

    def action_save(self) -> None:
        """Ask which parameters to save, then to which file."""
        row = self._list.current
        shown = list(dict.fromkeys(each.node for each in self._list.rows if each.parameter or not each.name))
        shown = [each for each in shown if each in self._snapshot.parameters]
        every = len(self._snapshot.parameters)
        choices: dict[str, tuple[tuple[str, ...], bool]] = {"all nodes": ((), False)}
        if row is not None and row.node in self._snapshot.parameters:
            choices[f"this node: {row.node}"] = ((row.node,), False)
        if self.words and 1 < len(shown) < every:
            choices[f"the {len(shown)} nodes shown"] = (tuple(shown), False)
        choices |= {
            f"{each}, only what differs from the defaults": (nodes, True) for each, (nodes, _) in tuple(choices.items())
        }
        find = partial(matching_options, [Option(each) for each in choices])
        self.ask(Choice("Save", lambda chosen: self._save_what(*choices[chosen]), find=find))

    def _save_what(self, nodes: tuple[str, ...], only_changed: bool) -> None:
        def save(path: Path) -> Answer:
            answer = self.console.parameters.save(str(path), nodes, only_changed=only_changed)
            if answer.ok:
                self.state_store.put(LAST_FILE, os.path.abspath(path))
            return answer

        self.host.call_later(partial(self.ask_file, "save to", "parameters.yaml", save, replaces=False))
