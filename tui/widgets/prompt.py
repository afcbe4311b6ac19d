"""A one-line prompt that appears at the foot of a pane: for a value, a filter, a file name."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bot_console.tui.format import harmless
from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.message import Message
from textual.suggester import SuggestFromList
from textual.widgets import Input, Label


class Prompt(Horizontal):
    """A label, a text field, and room for what is wrong with the text."""

    DEFAULT_CSS = """
    Prompt { height: 1; display: none; background: $panel; }
    Prompt.open { display: block; }
    Prompt Label { color: $text-muted; padding: 0 1; width: auto; }
    Prompt Input { border: none; height: 1; padding: 0; background: $panel; width: 1fr; }
    Prompt Input:focus { border: none; }
    Prompt .wrong { color: $warning; padding: 0 1; }
    """

    class Closed(Message):
        """The prompt was answered (`text`) or given up (`text` None)."""

        def __init__(self, purpose: str, text: str | None) -> None:
            super().__init__()
            self.purpose = purpose
            self.text = text

    class Typed(Message):
        """The text has changed."""

        def __init__(self, purpose: str, text: str) -> None:
            super().__init__()
            self.purpose = purpose
            self.text = text

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._purpose = ""
        self._check: Callable[[str], str] = lambda text: ""

    def compose(self) -> ComposeResult:
        """Label, field, complaint."""
        yield Label("", markup=False, id="prompt-label")
        yield Input(id="prompt-input", select_on_focus=True)
        yield Label("", markup=False, classes="wrong", id="prompt-wrong")

    def open(
        self,
        purpose: str,
        label: str,
        text: str = "",
        check: Callable[[str], str] | None = None,
        suggestions: Sequence[str] = (),
    ) -> None:
        """Ask; `check` says in words what is wrong with a text, empty when nothing is.

        The first of the `suggestions` that begins as the text does is shown dim; the right arrow key takes it.
        """
        self._purpose = purpose
        self._check = check or (lambda text: "")
        self.query_one("#prompt-label", Label).update(harmless(label))
        field = self.query_one("#prompt-input", Input)
        field.suggester = SuggestFromList(suggestions, case_sensitive=False) if suggestions else None
        field.select_on_focus = not suggestions
        field.value = text
        field.cursor_position = len(text)
        self._complain(text)
        self.add_class("open")
        field.focus()

    @property
    def is_open(self) -> bool:
        """Whether it asks."""
        return self.has_class("open")

    def _complain(self, text: str) -> str:
        wrong = self._check(text)
        self.query_one("#prompt-wrong", Label).update(harmless(wrong))
        return wrong

    def on_input_changed(self, event: Input.Changed) -> None:
        """Check while typing."""
        event.stop()
        if self.is_open:
            self._complain(event.value)
            self.post_message(self.Typed(self._purpose, event.value))

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Answer."""
        event.stop()
        if not self._complain(event.value):
            self._close(event.value)

    def key_escape(self) -> None:
        """Give up."""
        if self.is_open:
            self._close(None)

    def _close(self, text: str | None) -> None:
        self.remove_class("open")
        self.post_message(self.Closed(self._purpose, text))
