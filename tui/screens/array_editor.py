"""The elements of an array as a list: edit, insert, delete and move with the keyboard, then set all at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.filter_syntax import Query, parse
from bot_console.tui.console.model import Value
from bot_console.tui.format import element_text
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.prompt.filtered import Searchable
from bot_console.tui.widgets.prompt.line import Prompt, find_open_prompt
from bot_console.tui.widgets.prompt.question import Element, Elements, Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.segment import Segment
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType

HINT = "s Set · Enter Edit · i Insert · a Add · d Delete · J K Move · u Undo"
"""The keys, most important first, as a narrow terminal cuts the end."""


class ElementRows(RowList):
    """One element per line, after its index."""

    def __init__(self, elements: Sequence[Element]) -> None:
        super().__init__()
        self.elements = list(elements)

    def row_count(self) -> int:
        """The number of elements."""
        return len(self.elements)

    def matches(self, index: int, query: Query) -> bool:
        """Whether an element, without its index, matches."""
        return query.matches(element_text(self.elements[index]))

    def row(self, index: int, width: int) -> list[Segment]:
        """Index and value."""
        digits = len(str(max(0, len(self.elements) - 1)))
        dim = self.row_style("dim")
        return [Segment(f" {index:>{digits}}  ", dim), Segment(sanitize(element_text(self.elements[index])))]


class ElementsScreen(QuestionScreen[Value], Searchable):  # pyright: ignore[reportIncompatibleMethodOverride] # of Textual
    """Asks for the elements of an array; nothing is set until the user confirms."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("elements")]
    DEFAULT_CSS = """
    ElementsScreen { align: center middle; }
    ElementsScreen Box { width: 95%; max-width: 90; height: 70%; }
    """

    def __init__(self, question: Elements) -> None:
        super().__init__(question)
        self._asked = question
        self._before: list[list[Element]] = []
        self._leaving = False

    def compose(self) -> ComposeResult:
        """The list, its state, and a field for one element."""
        with Box() as box:
            box.border_title = Text(sanitize(self._asked.label))
            box.border_subtitle = HINT
            yield ElementRows(self._asked.values)
            yield StaticText(id="elements-state")
            yield Prompt(id="elements-prompt")

    @property
    def _list(self) -> ElementRows:
        return self.query_one(ElementRows)

    def on_mount(self) -> None:
        """Focus the list."""
        self._list.focus()
        self._report()

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Disable the keys of the list while an element is typed."""
        return find_open_prompt(self) is None and super().check_action(action, parameters)

    def _report(self, what: str = "") -> None:
        count = len(self._list.elements)
        state = counted(count, "element") if count else "empty: i inserts the first element"
        changed = " · changed, s sets it" if self._changed else ""
        self._leaving = False
        self.query_one("#elements-state", StaticText).show_text(what or state + changed)

    @property
    def _changed(self) -> bool:
        return tuple(self._list.elements) != tuple(self._asked.values)

    def _ask(self, label: str, text: str, then: Callable[[Element], object]) -> None:
        def answered(typed: str) -> None:
            self._change()
            then(self._asked.parse(typed))
            self._list.rows_changed()
            self._report()

        self.query_one(Prompt).ask(Line(label, answered, text=text, check=partial(_problem, self._asked.parse)))

    def ask_words(self, line: Line) -> None:
        """Ask for search words below the list."""
        self.query_one(Prompt).ask(line)

    def apply_filter(self, words: str) -> None:
        """Do nothing: a filter hides no elements, since they are identified by their indices."""

    def find(self, words: str, step: int) -> bool:
        """Go to the next matching element; returns whether there is one."""
        return self._list.find(parse(words), step)

    def is_on_match(self, words: str) -> bool:
        """Whether the element at the cursor matches."""
        return self._list.cursor < len(self._list.elements) and self._list.matches(self._list.cursor, parse(words))

    def _change(self) -> None:
        """Save the list for undo."""
        self._before.append(list(self._list.elements))

    def action_edit(self) -> None:
        """Edit the element at the cursor, or insert a first one if there is none."""
        shown = self._list
        if not shown.elements:
            self.action_insert(0)
            return
        at = shown.cursor
        self._ask(f"[{at}]", element_text(shown.elements[at]), partial(shown.elements.__setitem__, at))

    def action_insert(self, behind: int) -> None:
        """Ask for a new element, before or after the one at the cursor."""
        shown = self._list
        at = min(shown.cursor + behind, len(shown.elements))

        def put(element: Element) -> None:
            shown.elements.insert(at, element)
            shown.rows_changed()
            shown.cursor = at

        self._ask(f"new [{at}] ({self._asked.kind.word.removesuffix(' array')})", "", put)

    def action_delete(self) -> None:
        """Delete the element at the cursor."""
        shown = self._list
        if shown.elements:
            self._change()
            del shown.elements[shown.cursor]
            shown.rows_changed()
            self._report()

    def action_move(self, step: int) -> None:
        """Move the element at the cursor, and the cursor with it."""
        shown, at = self._list, self._list.cursor
        if 0 <= at + step < len(shown.elements):
            self._change()
            shown.elements.insert(at + step, shown.elements.pop(at))
            shown.rows_changed()
            shown.cursor = at + step
            self._report()

    def action_undo(self) -> None:
        """Undo the last change to the list."""
        if self._before:
            self._list.elements = self._before.pop()
            self._list.rows_changed()
            self._report()

    def action_take(self) -> None:
        """Answer with the array as edited."""
        if self._changed:
            self.answer(tuple(self._list.elements))
        else:
            self.give_up()

    def action_give_up(self) -> None:
        """Close the screen; if there are changes, only when asked a second time."""
        if not self._changed or self._leaving:
            self.give_up()
            return
        self._report("The array was changed: s sets it, esc again discards the changes.")
        self._leaving = True


def _problem(parse: Callable[[str], Element], text: str) -> str:
    try:
        parse(text)
    except ValueError as error:
        return str(error)
    return ""
