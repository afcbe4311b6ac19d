"""The mode in which keys arrange the panes, until Escape; the panes stay visible and live."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar, Protocol

from bot_console.tui import keymap
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import Key, key_text
from bot_console.tui.layout.tree import SplitDirection
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.widgets.prompt.line import KEYS, Prompt, find_open_prompt
from bot_console.tui.widgets.prompt.question import Line
from rich.style import Style
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.events import Resize
from textual.widgets import Static

HELP = (
    "The panes stay live while you arrange them. The arrows select one; the keys below split, resize and move it.\n"
    "w saves the result under a name, o shows another layout, and Escape goes back to the panes."
)
DROPPED = (
    "arrange.open",
    "arrange.undo",
    "arrange.narrower",
    "arrange.higher",
    "arrange.another",
    "arrange.close",
    "arrange.below",
    "arrange.beside",
    "arrange.left",
)
"""Keys that the line leaves out if there is little room, in this order; the others are always shown."""


class Arranger(Protocol):
    """The operations on panes; each method acts on the selected one."""

    def select(self, dx: int, dy: int) -> None:
        """Select the pane in a direction."""
        ...

    def exchange(self, dx: int, dy: int) -> None:
        """Swap with the pane in a direction."""
        ...

    def split(self, direction: SplitDirection) -> None:
        """Ask for a pane and put it `beside` or `below`."""
        ...

    def put_another(self) -> None:
        """Ask for a pane and put it here instead."""
        ...

    def close(self) -> None:
        """Remove the pane."""
        ...

    def grow(self, columns: int, lines: int) -> None:
        """Make the pane wider or taller by a number of steps; negative numbers shrink it."""
        ...

    def even(self) -> None:
        """Give all panes equal space."""
        ...

    def turn(self) -> None:
        """Turn the split: panes that are side by side move one below the other, and vice versa."""
        ...

    def undo(self) -> None:
        """Undo the last change."""
        ...

    def open_layout(self) -> None:
        """Ask for a layout and show it."""
        ...

    def name_question(self) -> Line:
        """The question for the name under which to save the current layout."""
        ...


class ArrangeScreen(DimmedScreen):
    """A line of keys over the last line of the screen; everything above it stays visible."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("arrange")]
    AUTO_FOCUS = ""
    DEFAULT_CSS = """
    ArrangeScreen Prompt { dock: bottom; margin-bottom: 1; }
    #arrange-keys { dock: bottom; height: 1; padding: 0 1; background: $accent; color: $background;
                    text-wrap: nowrap; text-overflow: ellipsis; }
    """

    def __init__(self, arranger: Arranger) -> None:
        super().__init__()
        self._arranger = arranger

    def compose(self) -> ComposeResult:
        """The line of keys."""
        yield Static(id="arrange-keys")
        yield Prompt()

    def on_resize(self, event: Resize) -> None:
        """Fit the line of keys to the width."""
        self._show_keys(event.size.width)

    def on_descendant_focus(self) -> None:
        """Show the keys of the prompt while it is open."""
        self._show_keys(self.size.width)

    def on_descendant_blur(self) -> None:
        """Show the keys that arrange panes again."""
        self._show_keys(self.size.width)

    def _show_keys(self, width: int) -> None:
        typing = find_open_prompt(self) is not None
        self.query_one("#arrange-keys", Static).update(KEYS if typing else keys_line(width - 2))

    def on_mount(self) -> None:
        """Highlight the selected pane."""
        self.app.screen_stack[0].add_class("arranging")  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Disable the keys that arrange panes while a name is typed."""
        return find_open_prompt(self) is None and super().check_action(action, parameters)

    def action_help(self) -> None:
        """Show all keys that arrange panes."""
        self.app.push_screen(HelpScreen(("arrange",), "Arranging the panes", HELP, alone=True))  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic

    def action_select(self, dx: int, dy: int) -> None:
        """Select the pane in a direction."""
        self._arranger.select(dx, dy)

    def action_exchange(self, dx: int, dy: int) -> None:
        """Swap with the pane in a direction."""
        self._arranger.exchange(dx, dy)

    def action_split(self, direction: SplitDirection) -> None:
        """Put another pane beside or below."""
        self._arranger.split(direction)

    def action_put_another(self) -> None:
        """Put another pane here."""
        self._arranger.put_another()

    def action_close_pane(self) -> None:
        """Remove the pane."""
        self._arranger.close()

    def action_grow(self, columns: int, lines: int) -> None:
        """Make the pane larger or smaller."""
        self._arranger.grow(columns, lines)

    def action_even(self) -> None:
        """Give all panes equal space."""
        self._arranger.even()

    def action_turn(self) -> None:
        """Turn the split."""
        self._arranger.turn()

    def action_undo(self) -> None:
        """Undo the last change."""
        self._arranger.undo()

    def action_open_layout(self) -> None:
        """Show a saved layout."""
        self._arranger.open_layout()

    def action_save_layout(self) -> None:
        """Save the current layout under a name."""
        self.query_one(Prompt).ask(self._arranger.name_question())

    def action_done(self) -> None:
        """Return to the panes."""
        self.app.screen_stack[0].remove_class("arranging")  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
        self.dismiss()


def keys_line(columns: int) -> Text:
    """The keys with their descriptions, as many as fit; the most important ones always."""
    keys = [key for key in TABLE["arrange"] if key.footer]
    for id in DROPPED:
        if _line(keys).cell_len <= columns:
            break
        keys = [key for key in keys if key.id != id]
    return _line(keys)


def _line(keys: Iterable[Key]) -> Text:
    line = Text(no_wrap=True)
    line.append("Arrange", Style(bold=True))
    for key in keys:
        line.append(f"  {key.shown or key_text(key, 1)}", Style(bold=True))
        line.append(f" {key.footer}")
    return line
