"""A list to choose one item from, narrowed by typing."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.item_list import ItemList
from bot_console.tui.widgets.prompt.question import Choice, Option
from bot_console.tui.widgets.static_text import StaticText
from rich.segment import Segment
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.widgets import Input


class OptionRows(ItemList[Option]):
    """Options, each with its title first, then its description."""

    can_focus = False

    def row(self, index: int, width: int) -> list[Segment]:
        """Title and description; the option at the cursor is marked."""
        option = self.rows[index]
        chosen = index == self.cursor
        style = self.row_style("strong" if chosen else "plain")
        dim = self.row_style("dim")
        return [
            Segment(f"{'▸' if chosen else ' '} {sanitize(option.title)}  ", style),
            Segment(sanitize(option.about), dim),
        ]


class PickerScreen(QuestionScreen[str]):
    """Asks for one of several options."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("picker")]
    DEFAULT_CSS = """
    PickerScreen { align: center middle; }
    PickerScreen Box { width: 90%; max-width: 110; height: 70%; }
    PickerScreen Input { border: none; height: 1; padding: 0; background: $panel; margin-bottom: 1; }
    PickerScreen Input:focus { border: none; }
    PickerScreen StaticText { text-wrap: wrap; }
    PickerScreen StaticText.wrong { color: $warning; }
    """

    def __init__(self, choice: Choice) -> None:
        super().__init__(choice)
        self._choice = choice
        self._every = 0

    def compose(self) -> ComposeResult:
        """The search field, and the matching options."""
        with Box() as box:
            box.border_title = Text(sanitize(self._choice.label))
            yield Input(placeholder=self._choice.hint)
            yield OptionRows()
            yield StaticText()

    @property
    def _list(self) -> OptionRows:
        return self.query_one(OptionRows)

    def on_mount(self) -> None:
        """Focus the search field."""
        self.set_focus(self.query_one(Input))
        self._every = len(self._choice.find(""))
        self._show("")

    def on_input_changed(self, event: Input.Changed) -> None:
        """Show the options that match."""
        self._show(event.value)

    def _show(self, typed: str) -> None:
        found, shown = self._choice.find(typed), self._list
        self.query_one(Box).border_subtitle = f"{len(found)} of {max(self._every, len(found))} · Enter OK · Esc Cancel"
        shown.cursor = 0
        shown.exchange(found, stay=False)
        self._explain("" if found else self._choice.empty, wrong=False)

    def _explain(self, text: str, *, wrong: bool) -> None:
        line = self.query_one(StaticText)
        line.show_whole(text, 3)
        line.set_class(wrong, "wrong")

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Answer with the option at the cursor, unless the attempt to use it fails."""
        event.stop()
        option = self._list.current
        if option is None:
            return
        answer = option.value or option.title
        wrong = self._choice.attempt(answer) if self.poll() else ""
        if wrong:
            self._explain(wrong, wrong=True)
        else:
            self.answer(answer)

    def action_move(self, step: int) -> None:
        """Move to another option."""
        self._list.action_cursor(step)

    def action_page(self, step: int) -> None:
        """Move by a page of options."""
        self._list.action_page(step)

    def action_end(self, end: int) -> None:
        """Move to the first or last option."""
        self._list.action_end(end)
