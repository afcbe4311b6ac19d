"""A one-line prompt at the bottom of a pane: for a value, a filter, or a file name."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.prompt.question import Line, Requester
from rich.cells import cell_len
from textual.binding import BindingType
from textual.containers import Horizontal
from textual.suggester import Suggester, SuggestFromList
from textual.widget import Widget
from textual.widgets import Input, Label

KEYS = "Enter OK · Esc Cancel"
"""The keys shown at the bottom of a box while a line is typed in it."""
AROUND_COLUMNS = 5
"""Columns around the label and after the text."""


class _Completing(Suggester):
    """Suggests the result of a function of the text, which may change at any time."""

    def __init__(self, complete: Callable[[str], str]) -> None:
        super().__init__(use_cache=False, case_sensitive=True)
        self._complete = complete

    async def get_suggestion(self, value: str) -> str | None:
        """The suggested continuation of the text."""
        return self._complete(value) or None


class Prompt(Requester[str], Horizontal):
    """A label, a text field, and an error message; made when first used.

    Every pane has a prompt, but few are ever used: their parts would be a third of all widgets mounted at the start.
    """

    DEFAULT_CSS = """
    Prompt { height: auto; max-height: 3; display: none; background: $panel; }
    Prompt.open { display: block; }
    Prompt Label { color: $text-muted; padding: 0 1; width: auto; max-width: 48%; }
    Prompt Input { border: none; height: 1; padding: 0; background: $panel; width: 1fr; }
    Prompt Input:focus { border: none; }
    Prompt .wrong { color: $warning; padding: 0 1; width: auto; }
    """
    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("prompt")]

    _line: Line | None = None
    _before: Widget | None = None
    _keys_around: str | None = None
    """The keys that the surrounding box shows while nothing is typed; None if the prompt is closed or in a pane."""

    def _make(self) -> None:
        self._label = Label("", markup=False)
        self._field = Input(select_on_focus=True)
        self._wrong = Label("", markup=False, classes="wrong")
        self.mount(self._label, self._field, self._wrong)

    def ask(self, line: Line) -> None:
        """Ask for a line; a question that is already open is cancelled."""
        self.give_up()
        if not self.children:
            self._make()
        self._question = self._line = line
        self._label.update(sanitize(line.label))
        field = self._field
        suggestions = line.suggestions
        if line.complete is not None:
            field.suggester = _Completing(line.complete)
        else:
            field.suggester = SuggestFromList(suggestions, case_sensitive=False) if suggestions else None
        field.select_on_focus = not suggestions
        field.value = line.text
        field.cursor_position = len(line.text)
        self._complain(line.text)
        self.add_class("open")
        self._before = self.screen.focused
        if isinstance(self.parent, Box):
            self._keys_around, self.parent.border_subtitle = self.parent.border_subtitle, KEYS
        # Immediately: `focus` would take effect only after keys that are already queued.
        self.screen.set_focus(field)

    def _complain(self, text: str) -> str:
        wrong = self._line.check(text) if self._line else ""
        message = wrong or (self._line.preview(text) if self._line else "")
        self._wrong.update(sanitize(message))
        self._wrong.styles.max_width = self._room_beside(text)
        return wrong

    def _room_beside(self, text: str) -> int:
        """The width for the message about the text: the rest of the line, but at least a third of it."""
        width = self.parent.content_size.width if isinstance(self.parent, Widget) else 0
        taken = cell_len(self._line.label if self._line else "") + cell_len(text) + AROUND_COLUMNS
        return max(width - taken, width // 3, 1)

    def on_input_changed(self, event: Input.Changed) -> None:
        """Check the text while it is typed."""
        event.stop()
        if self.is_open and self._line and not self._complain(event.value):
            self._line.typed(event.value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Answer with the text, if it is valid."""
        event.stop()
        if self.is_open and not self._complain(event.value):
            self.answer(event.value)

    def on_descendant_blur(self) -> None:
        """Keep the focus if it moves elsewhere in the pane; cancel if it moves to another pane."""
        focused, field = self.screen.focused, self._field
        if not self.is_open or focused is None or focused is field:  # None when the terminal itself loses the focus
            return
        if self.parent in focused.ancestors:
            self.take_focus()
        else:
            self.give_up()

    def take_focus(self) -> None:
        """Take the focus again, without changing whether the text is selected."""
        self._field.select_on_focus = False
        self.screen.set_focus(self._field)

    def action_give_up(self) -> None:
        """Close without an answer."""
        self.give_up()

    def close(self) -> None:
        """Hide, and restore the focus."""
        self.remove_class("open")
        if self._keys_around is not None and isinstance(self.parent, Box):
            self.parent.border_subtitle, self._keys_around = self._keys_around, None
        if self.screen.focused is self._field:
            self.screen.set_focus(self._before)
        self._before = None

    def report(self, why: str) -> None:
        """Notify the user why the prompt closes."""
        self.notify(why, severity="warning", markup=False)


def find_open_prompt(widget: Widget) -> Prompt | None:
    """The open prompt in a widget, which receives all keys; None if there is none."""
    return next((each for each in widget.query(Prompt) if each.is_open), None)
