"""The parameter pane: a tree of all nodes' parameters, edited in place; a refusal stays in its row with its reason."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from functools import partial

from bot_console.tui import keymap
from bot_console.tui.console.kinds import ARRAYS
from bot_console.tui.console.model import ChangeSource, ConsoleSnapshot, Kind, ParameterInfo, SetOutcome, Value
from bot_console.tui.console.protocol import Answer
from bot_console.tui.console.query import parse
from bot_console.tui.format import command_of, field_text, harmless, parse_value, range_text
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.parameters.details import details
from bot_console.tui.panes.parameters.rows import Row, View, rows
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.widgets.prompt.common import file_line, filter_line
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Elements, Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.words import Words
from rich.text import Text
from textual.app import ComposeResult

LEAST = 3
"""Lines of detail that every parameter has: what it is for, its facts, its command."""

SHARE = 3
"""The detail takes at most this part of the pane's height."""


class ParametersPane(Pane):
    """Parameters of all nodes."""

    TITLE = "Parameters"
    HELP = (
        "Every node's parameters, live. Enter edits; + and - move a number by its step or a hundredth of its range.\n"
        "A refused value snaps back; the row says who refused it and why. A dot marks what differs from its start\n"
        "value: the one that it had when the console first saw it."
    )
    BINDINGS = keymap.bindings("parameters")

    def __init__(self, *args: object, **kwargs: object) -> None:
        super().__init__(*args, **kwargs)  # type: ignore[arg-type]
        self._snapshot = ConsoleSnapshot()
        self._view = View()
        self._filter = ""
        self._expected = ""
        self._chosen = False
        """Whether the cursor was moved; until then it stays on the first row, in whatever order nodes come."""

    def compose(self) -> ComposeResult:
        """The tree, what is known of the parameter at the cursor, and a prompt."""
        yield ParameterRows()
        yield Words(id="parameter-detail")
        yield Prompt(id="parameter-prompt")

    @property
    def _list(self) -> ParameterRows:
        return self.query_one(ParameterRows)

    def focus_target(self) -> None:
        """The tree takes the keys."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Draw the parameters anew when they are another object."""
        if snapshot.parameters is not self._snapshot.parameters or snapshot.problem != self._snapshot.problem:
            self._snapshot = snapshot
            self._arrange()
        self._snapshot = snapshot

    def expect(self, node: str) -> None:
        """Go to a node, as soon as it is there."""
        self._expected = node
        self._arrange()

    def _go_to_expected(self) -> None:
        shown = self._list
        found = next((index for index, row in enumerate(shown.rows) if row.node == self._expected), None)
        self.caption(f"waits for {self._expected}" if found is None else "")
        if found is not None:
            self._expected = ""
            shown.cursor = found

    def _arrange(self) -> None:
        """Make the rows, keep the cursor on its parameter, draw what differs."""
        shown, old = self._list, self._list.rows
        at = shown.current
        new = rows(self._snapshot.parameters, self._view)
        moved = shown.take(new)
        if moved:
            shown.refresh()
        self.caption(self._filtered(new))
        if len(old) == len(new):
            for index, (before, after) in enumerate(zip(old, new, strict=True)):
                if before != after:
                    self._forget_refusal(before, after)
                    shown.row_changed(index)
        else:
            if at is not None and self._chosen:
                where = (each for each, row in enumerate(new) if (row.node, row.name) == (at.node, at.name))
                shown.set_reactive(ParameterRows.cursor, next(where, min(shown.cursor, max(0, len(new) - 1))))
            shown.rows_changed()
            shown.show_cursor()
        if self._expected:
            self._go_to_expected()
        self._describe()

    def _filtered(self, shown: list[Row]) -> str:
        """The filter, and how many of the parameters pass it."""
        if not self._filter:
            return ""
        every = sum(len(tree.parameters) for tree in self._snapshot.parameters.values())
        return f"/{self._filter}  {sum(row.parameter is not None for row in shown)} of {every}"

    def _forget_refusal(self, before: Row, after: Row) -> None:
        if before.parameter and after.parameter and before.parameter.value != after.parameter.value:
            self._list.refused.pop((after.node, after.parameter.name), None)

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Tell of the parameter at the cursor."""
        event.stop()
        self._chosen = self._chosen or event.index > 0
        self._describe()

    def _describe(self) -> None:
        """Say what is known, in as many lines as it needs."""
        words, text = self.query_one("#parameter-detail", Words), self._details(self._list.current)
        most = max(LEAST, self.size.height // SHARE)
        need = len(text.wrap(self.host.console, max(1, words.size.width))) if words.size.width else LEAST
        height = min(max(need, LEAST), most) + 1  # one is the line above
        if words.styles.height is None or words.styles.height.value != height:
            words.styles.height = height
        words.say(text)

    def _details(self, row: Row | None) -> Text:
        if row is None:
            if self._filter or self._view.only_changed:
                return Text("Nothing matches. Press / to change the filter.", "dim")
            return Text(harmless(self._snapshot.problem) or "Waiting for nodes with parameters ...", "dim")
        if row.parameter is None:
            return Text(harmless(row.problem or f"{row.node}  {row.count} parameters"), "dim")
        return details(row.parameter, self._list.refused.get((row.node, row.parameter.name)))

    def _at(self) -> ParameterInfo | None:
        row = self._list.current
        return row.parameter if row else None

    def action_edit(self) -> None:
        """Edit a value, toggle a bool, list the elements of an array, open or close a node."""
        row = self._list.current
        if row is None:
            return
        parameter = row.parameter
        if parameter is None:
            self.action_fold(not row.folded)
        elif parameter.kind in ARRAYS:
            values = parameter.value if isinstance(parameter.value, tuple) else ()
            then = partial(self._set, parameter)
            gone = partial(self._gone, parameter)
            self.ask(Elements(_label(parameter), then, gone, values=values, kind=parameter.kind))
        else:
            self.action_edit_text()

    def action_edit_text(self) -> None:
        """Edit a value on one line; toggle a bool."""
        parameter = self._at()
        if parameter is None:
            return
        if parameter.kind is Kind.BOOL and isinstance(parameter.value, bool):
            self._set(parameter, not parameter.value)
            return
        self.ask(
            Line(
                _label(parameter),
                partial(self._set_text, parameter),
                partial(self._gone, parameter),
                text=field_text(parameter.value),
                check=partial(_wrong, parameter),
            )
        )

    def _gone(self, parameter: ParameterInfo) -> str:
        """Why a parameter cannot be set any more."""
        tree = self.console.snapshot().parameters.get(parameter.node)
        if tree is None:
            return f"{parameter.node} has left; {parameter.name} was not set."
        if tree.get(parameter.name) is None and not tree.problem:
            return f"{parameter.node} has no parameter {parameter.name} any more; it was not set."
        return ""

    def _set(self, parameter: ParameterInfo, value: Value, source: ChangeSource = ChangeSource.EDIT) -> None:
        answer = self.console.set_parameters(parameter.node, {parameter.name: value}, source)
        answer.add_done_callback(lambda done: self.host.call_later(self._outcome, done))

    def _outcome(self, done: Future[tuple[SetOutcome, ...]]) -> None:
        error = done.exception()
        if error is not None:
            self.notify(str(error), severity="error", markup=False)
            return
        for each in done.result():
            key = (each.node, each.name)
            if each.accepted:
                self._list.refused.pop(key, None)
            else:
                self._list.refused[key] = each
        self._list.refresh()
        self._describe()

    def action_dismiss(self) -> bool:
        """Take the mark of a refusal away; whether there was one."""
        row = self._list.current
        key = (row.node, row.parameter.name if row.parameter else "") if row else ("", "")
        marked = self._list.refused.pop(key, None) is not None
        if marked:
            self._list.row_changed(self._list.cursor)
            self._describe()
        return marked

    def action_clear(self) -> None:
        """Take the mark at the cursor away, or else the filter."""
        if not self.action_dismiss():
            self._apply_filter("")

    def action_nudge(self, steps: int) -> None:
        """Move a number by its step, or by a hundredth of its range."""
        parameter = self._at()
        if parameter is None or isinstance(parameter.value, (bool, str, tuple)) or parameter.value is None:
            return
        limits = parameter.range
        integer = parameter.kind is Kind.INTEGER
        step = limits.step if limits and limits.step else ((limits.high - limits.low) / 100 if limits else 0.0)
        step = step or max(abs(parameter.value) / 10, 0.1)
        step = max(1, round(step)) if integer else _round_step(step)
        value = parameter.value + steps * step
        if limits:
            value = min(max(value, limits.low), limits.high)
        self._set(parameter, int(value) if integer else round(value, 10))

    def action_reset(self) -> None:
        """Put the default back."""
        parameter = self._at()
        if parameter is not None and parameter.changed:
            self._set(parameter, parameter.default)

    def action_undo(self) -> None:
        """Undo the last change made here."""
        self.console.undo().add_done_callback(lambda done: self.host.call_later(self._tell, done))

    def action_redo(self) -> None:
        """Redo."""
        self.console.redo().add_done_callback(lambda done: self.host.call_later(self._tell, done))

    def _tell(self, done: Future[Answer]) -> None:
        answer = done.result()
        self.notify(answer.text, severity="information" if answer.ok else "warning", markup=False)

    def action_filter(self) -> None:
        """Ask for a filter."""
        given_up = partial(self._filter_is, "")
        self.ask(replace(filter_line(self._filter, self._apply_filter), then=self._filter_is, given_up=given_up))

    def _filter_is(self, text: str) -> None:
        self._apply_filter(text)
        self._to_first_match()

    def _set_text(self, parameter: ParameterInfo, text: str) -> None:
        if text != field_text(parameter.value):
            self._set(parameter, parse_value(text, parameter))

    def _apply_filter(self, text: str) -> None:
        self._filter = text
        self._view = replace(self._view, query=parse(text))
        self._arrange()

    def _to_first_match(self) -> None:
        if self._filter and self._at() is None:
            matches = (index for index, row in enumerate(self._list.rows) if row.parameter is not None)
            self._list.cursor = next(matches, 0)

    def action_toggle_changed(self) -> None:
        """Only what differs from its default, or all."""
        self._view = replace(self._view, only_changed=not self._view.only_changed)
        self._arrange()

    def action_toggle_built_in(self) -> None:
        """Built-in parameters too, or not."""
        self._view = replace(self._view, built_in=not self._view.built_in)
        self._arrange()

    def action_fold(self, closed: bool) -> None:
        """Close or open the node at the cursor."""
        row = self._list.current
        if row is None:
            return
        folded = set(self._view.folded) - {row.node} | ({row.node} if closed else set[str]())
        self._view = replace(self._view, folded=frozenset(folded))
        if closed:
            heads = (index for index, each in enumerate(self._list.rows) if each.node == row.node)
            self._list.cursor = next(heads, 0)
        self._arrange()

    def action_fold_all(self) -> None:
        """Close all nodes, or open all."""
        nodes = frozenset(self._snapshot.parameters)
        self._view = replace(self._view, folded=frozenset() if self._view.folded else nodes)
        self._arrange()

    def action_plot(self) -> None:
        """Plot this parameter."""
        parameter = self._at()
        if parameter is not None:
            self.post_message(self.PlotWanted(f"{parameter.node}:{parameter.name}"))

    def action_copy(self) -> None:
        """Copy the command that sets this parameter, through the terminal (OSC 52)."""
        parameter = self._at()
        if parameter is not None:
            text = command_of(parameter, parameter.value)
            self.host.copy_to_clipboard(text)
            self.notify(text, title="Copied", markup=False)

    def action_save(self) -> None:
        """Ask where to save."""
        self.ask(file_line("save all parameters to", "parameters.yaml", self._save))

    def _save(self, path: str) -> None:
        answer = self.console.save_parameters(path)
        self.notify(answer.text, severity="information" if answer.ok else "error", markup=False)

    def on_resize(self) -> None:
        """The detail is wrapped anew."""
        self.call_after_refresh(self._describe)


def _label(parameter: ParameterInfo) -> str:
    """Name, kind and range of what is asked for."""
    facts = (parameter.kind.word, range_text(parameter.range, parameter.kind))
    return f"{parameter.name} ({', '.join(each for each in facts if each)})"


def _wrong(parameter: ParameterInfo, text: str) -> str:
    try:
        parse_value(text, parameter)
    except ValueError as error:
        return str(error)
    return ""


def _round_step(step: float) -> float:
    """The nearest of 1, 2, 5 times a power of ten."""
    from math import floor, log10

    power = 10.0 ** floor(log10(step))
    return min((1, 2, 5, 10), key=lambda each: abs(each * power - step)) * power
