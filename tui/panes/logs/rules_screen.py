"""The screen for editing log rules: add, change and delete them, and turn them on and off."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.panes.logs.rules import COLOURS, HIDE, Rule, RuleBook, with_next_colour
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.item_list import ItemList
from bot_console.tui.widgets.prompt.common import filter_problem
from bot_console.tui.widgets.prompt.line import Prompt, find_open_prompt
from bot_console.tui.widgets.prompt.question import Line
from bot_console.tui.widgets.static_text import StaticText
from rich.segment import Segment
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType

NO_RULES = "No rules yet: in the log, x hides lines like the one at the cursor, and + highlights them."
HINT = "Space On/off · Enter Edit · c Colour · a Add · d Delete · Esc Close"


class RuleRows(ItemList[Rule]):
    """One rule per line."""

    COMPONENT_CLASSES: ClassVar[set[str]] = {f"log-rows--{each}" for each in COLOURS}

    def row(self, index: int, width: int) -> list[Segment]:
        """Whether the rule is on, its effect and its filter."""
        rule = self.rows[index]
        name = f"log-rows--{rule.colour}" if rule.colour and rule.on else "row-list--dim"
        style = self.part_style(name) if not rule.on or rule.colour else None
        return [Segment(f" {'●' if rule.on else '○'} {rule.colour or HIDE:<7} {sanitize(rule.words)}", style)]


class RulesScreen(DimmedScreen):
    """Edits the rules; every change is applied and stored at once."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("rules")]
    DEFAULT_CSS = """
    RulesScreen { align: center middle; }
    RulesScreen Box { width: 90%; max-width: 110; height: 60%; }
    """

    def __init__(self, book: RuleBook, changed: Callable[[], object]) -> None:
        super().__init__()
        self._book = book
        self._changed = changed

    def compose(self) -> ComposeResult:
        """The rules, a status line, and a field for a filter."""
        with Box() as box:
            box.border_title = Text("Rules of the log")
            box.border_subtitle = HINT
            yield RuleRows(self._book.rules)
            yield StaticText(id="rules-state")
            yield Prompt(id="rules-prompt")

    @property
    def _list(self) -> RuleRows:
        return self.query_one(RuleRows)

    def on_mount(self) -> None:
        """Focus the list."""
        self._list.focus()
        self._report()

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Disable the keys of the list while a filter is typed."""
        return find_open_prompt(self) is None and super().check_action(action, parameters)

    def _report(self, problem: str = "") -> None:
        empty = "" if self._book.rules else NO_RULES
        count = f"{counted(len(self._book.rules), 'rule')}, kept in {self._book.path}"
        self.query_one("#rules-state", StaticText).show_text(problem or empty or count)

    def _exchange(self, before: Rule | None, after: Rule | None) -> None:
        """Replace a rule; `before` None adds one, `after` None deletes it."""
        rules = [each for each in self._book.rules if each != before or after is not None]
        rules = [after if each == before and after else each for each in rules]
        if before is None and after is not None:
            rules.append(after)
        problem = self._book.change(rules)
        self._list.exchange(self._book.rules)
        self._changed()
        self._report(problem)

    def action_switch(self) -> None:
        """Turn the rule at the cursor on or off."""
        rule = self._list.current
        if rule is not None:
            self._exchange(rule, replace(rule, on=not rule.on))

    def action_colour(self) -> None:
        """Switch to the next colour; after the last one, hide the lines."""
        rule = self._list.current
        if rule is not None:
            self._exchange(rule, with_next_colour(rule))

    def action_delete(self) -> None:
        """Delete the rule."""
        if self._list.current is not None:
            self._exchange(self._list.current, None)

    def action_edit(self) -> None:
        """Edit the filter of the rule; ask for a first one if there is none."""
        rule = self._list.current
        if rule is None:
            self.action_add()
        else:
            self._ask("words", rule.words, lambda words: self._exchange(rule, replace(rule, words=words)))

    def action_add(self) -> None:
        """Ask for the filter of a new rule that highlights lines."""

        def add(words: str) -> None:
            _, problem = self._book.add(words, hide=False)
            self._list.exchange(self._book.rules)
            self._list.action_end(1)
            self._changed()
            self._report(problem)

        self._ask("highlight lines with", "", add)

    def _ask(self, label: str, words: str, then: Callable[[str], object]) -> None:
        self.query_one(Prompt).ask(
            Line(
                label, lambda typed: then(typed.strip()), text=words, check=lambda typed: _words_problem(typed.strip())
            )
        )


def _words_problem(words: str) -> str:
    return filter_problem(words) if words else "type the words of a filter"
