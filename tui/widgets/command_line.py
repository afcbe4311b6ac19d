"""The command line below the panes: completion with Tab, and the history of earlier runs."""

from __future__ import annotations

from typing import ClassVar, Protocol

from bot_console.tui.commanding.completion import Completion, common_extension, split
from bot_console.tui.commanding.history import LineHistory
from bot_console.tui.keymap import bindings
from bot_console.tui.text.sanitize import sanitize
from rich.cells import cell_len
from rich.text import Text
from textual.binding import BindingType
from textual.containers import Horizontal, Vertical
from textual.widget import Widget
from textual.widgets import Input, Label, Static

HINT = "Tab Complete · ↑ ↓ History · ^r Search history · Esc Close"

AROUND_COLUMNS = 4
"""Columns for the colon, and after the end of the line."""


class Lines(Protocol):
    """Checks, explains and runs command lines."""

    def wrong(self, line: str) -> str:
        """The problem with a line; empty if there is none."""
        ...

    def preview(self, line: str) -> str:
        """The effect of a line, or its usage."""
        ...

    def run(self, line: str) -> None:
        """Run a line."""
        ...


class CommandField(Vertical):
    """A line, with candidates above it and its error beside it; built when first opened."""

    DEFAULT_CSS = """
    CommandField { display: none; height: auto; max-height: 4; background: $panel; }
    CommandField.open { display: block; }
    CommandField Static { height: 1; background: $panel; color: $text-muted; padding: 0 1; text-wrap: nowrap; }
    CommandField Horizontal { height: auto; max-height: 3; background: $panel; }
    CommandField Label { width: auto; color: $text-muted; padding: 0 0 0 1; }
    CommandField Input { border: none; height: 1; padding: 0; background: $panel; width: 1fr; }
    CommandField Input:focus { border: none; }
    CommandField .wrong { color: $warning; padding: 0 1; width: auto; height: auto; text-wrap: wrap; }
    """
    BINDINGS: ClassVar[list[BindingType]] = [*bindings("command")]

    def __init__(self, lines: Lines, completion: Completion) -> None:
        super().__init__()
        self._lines = lines
        self._completion = completion
        self._history = LineHistory()
        self._before: Widget | None = None
        self._tried = -1
        """The index of the candidate that is in the line; -1 for the typed text."""
        self._typed = ""
        """The text that was typed before the first candidate replaced it."""
        self._own_change = ""

    def _make(self) -> None:
        self._candidates = Static("", markup=False)
        self._field = Input(select_on_focus=False)
        self._wrong = Label("", markup=False, classes="wrong")
        line = Horizontal()
        self.mount(self._candidates, line)
        line.mount(Label(":", markup=False), self._field, self._wrong)

    @property
    def is_open(self) -> bool:
        """Whether a line is being typed."""
        return self.has_class("open")

    def open(self) -> None:
        """Take the focus, with an empty line."""
        if self.is_open:
            return
        if not self.children:
            self._make()
        self._before = self.screen.focused
        self._history.restart_walk()
        self._put("")
        self.add_class("open")
        # Immediately: `focus` would take effect only after keys that are already queued.
        self.screen.set_focus(self._field)
        self._begin()

    def take_focus(self) -> None:
        """Take the focus again, after the line was hidden."""
        self.screen.set_focus(self._field)

    def close(self) -> None:
        """Hide, and give the focus back."""
        self.remove_class("open")
        self._completion.forget()
        if self.screen.focused is self._field:
            self.screen.set_focus(self._before)
        self._before = None

    def poll(self) -> None:
        """Show candidates that have arrived in the meantime; called periodically."""
        if self.is_open and self._tried < 0:
            self._show()

    def _put(self, text: str) -> None:
        self._own_change = text
        self._field.value = text
        self._field.cursor_position = len(text)

    def _begin(self) -> None:
        """Start completing from what is typed now."""
        self._tried, self._typed = -1, self._field.value
        self._complain("")
        self._show()

    def on_input_changed(self, event: Input.Changed) -> None:
        """Look for candidates."""
        event.stop()
        if self.is_open and event.value != self._own_change:
            self._own_change = "\0"
            self._history.restart_walk()
            self._begin()

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Run the line, or report what is wrong with it."""
        event.stop()
        line = event.value.strip()
        wrong = self._lines.wrong(line) if line else ""
        if wrong:
            self._complain(wrong)
            return
        self.close()
        if line:
            self._history.add(line)
            self._lines.run(line)

    def on_descendant_blur(self) -> None:
        """Close when the focus moves to a pane; if the terminal loses it, no widget has it."""
        focused = self.screen.focused
        if self.is_open and focused is not None and focused is not self._field:
            self.close()

    def _complain(self, wrong: str) -> None:
        message = wrong or self._lines.preview(self._field.value)
        self._wrong.update(sanitize(message))
        # At least a third of the width, so that an error can be read in two or three lines.
        width = self.size.width
        self._wrong.styles.max_width = max(width - cell_len(self._field.value) - AROUND_COLUMNS, width // 3, 10)

    def _show(self) -> None:
        found = self._completion.found(self._typed)
        waits = self._completion.waits
        text = Text()
        if not found:
            text.append("searching ..." if waits else HINT)
        first = 0 if self._tried < 0 else max(0, self._tried - 2)
        for index, each in enumerate(found[first:], first):
            name = sanitize(each)
            if text.cell_len + cell_len(name) > max(20, self.size.width - 12):
                text.append(f"  +{len(found) - index}")
                break
            text.append(name, "reverse" if index == self._tried else "")
            text.append("  ")
        shown = self._candidates
        if getattr(shown, "message", None) != (text.plain, text.spans):
            shown.message = (text.plain, text.spans)  # type: ignore[attr-defined] -- what is drawn already
            shown.update(text, layout=False)

    def action_complete(self, step: int) -> None:
        """Complete the word as far as all candidates agree; then cycle through the candidates."""
        found = self._completion.found(self._typed)
        if not found:
            return
        before, begun = split(self._typed)
        longer = common_extension(found, begun)
        if self._tried < 0 and len(longer) > len(begun) and len(found) > 1:
            self._put(" ".join([*before, longer]))
            self._begin()
            return
        if len(found) == 1:
            self._put(" ".join([*before, found[0]]) + " ")
            self._begin()
            return
        if self._tried >= 0:
            self._tried = (self._tried + step) % len(found)
        else:
            self._tried = 0 if step > 0 else len(found) - 1
        self._put(" ".join([*before, found[self._tried]]))
        self._show()

    def action_history(self, step: int) -> None:
        """Recall an earlier line that begins like this one, or go to a later one."""
        self._put(self._history.step(self._field.value, step))
        self._begin()

    def action_search_history(self) -> None:
        """Recall an earlier line that contains what was typed."""
        self._put(self._history.step(self._field.value, -1, anywhere=True))
        self._begin()

    def action_give_up(self) -> None:
        """Close without running anything."""
        self.close()
