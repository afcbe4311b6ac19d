"""Choosing a launch file: those of the workspace, narrowed by typing; a path may be typed as well."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import ClassVar

from bot_console.tui.console.query import Query, parse
from bot_console.tui.format import harmless
from bot_console.tui.widgets.row_list import RowList
from rich.segment import Segment
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Vertical
from textual.screen import ModalScreen
from textual.widgets import Input, Static


class FileRows(RowList):
    """Launch files: name first, folder after it."""

    can_focus = False

    def __init__(self, files: Sequence[str]) -> None:
        super().__init__()
        self.files = files

    def row_count(self) -> int:
        """How many files there are."""
        return len(self.files)

    def row(self, index: int, width: int) -> list[Segment]:
        """One file."""
        path = Path(self.files[index])
        mark = "▸ " if index == self.cursor else "  "
        dim = self.get_component_rich_style("row-list--dim", partial=True)
        style = self.get_component_rich_style("row-list--strong", partial=True) if index == self.cursor else dim
        return [Segment(f"{mark}{harmless(path.name)}  ", style), Segment(harmless(str(path.parent)), dim)]


class PickerScreen(ModalScreen["str | None"]):
    """The path of a launch file, or None."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "give_up", "Close"),
        Binding("down", "move(1)", "Down", show=False, priority=True),
        Binding("up", "move(-1)", "Up", show=False, priority=True),
        Binding("ctrl+q,ctrl+c", "app.quit", "Quit", show=False, priority=True),
    ]
    DEFAULT_CSS = """
    PickerScreen { align: center middle; }
    PickerScreen Vertical { width: 90%; max-width: 110; height: 70%; background: $panel; border: round $primary;
                            padding: 0 1; }
    PickerScreen Input { border: none; height: 1; padding: 0; background: $panel; margin-bottom: 1; }
    PickerScreen Input:focus { border: none; }
    PickerScreen RowList { background: $panel; }
    PickerScreen Static { height: 1; color: $text-muted; }
    """

    def __init__(self, files: Sequence[str]) -> None:
        super().__init__()
        self._files = files

    def compose(self) -> ComposeResult:
        """What is typed, and the files that match."""
        with Vertical() as box:
            box.border_title = "Open a launch file"
            box.border_subtitle = "enter opens · esc closes"
            yield Input(placeholder="words of its name, or a path")
            yield FileRows(self._files)
            yield Static("" if self._files else "No launch files in the workspace; type a path.", markup=False)

    def on_mount(self) -> None:
        """Typing narrows."""
        self.query_one(Input).focus()

    def on_input_changed(self, event: Input.Changed) -> None:
        """Show the files that match."""
        try:
            query = parse(event.value)
        except ValueError:
            query = Query()
        shown = self.query_one(FileRows)
        shown.files = [each for each in self._files if query.matches(each)]
        shown.rows_changed()

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Open the file at the cursor, else what was typed."""
        shown = self.query_one(FileRows)
        typed = event.value.strip()
        self.dismiss(shown.files[shown.cursor] if shown.files else (str(Path(typed).expanduser()) if typed else None))

    def action_move(self, step: int) -> None:
        """Another file."""
        shown = self.query_one(FileRows)
        shown.action_cursor(step)
        shown.refresh()

    def action_give_up(self) -> None:
        """Open nothing."""
        self.dismiss(None)
