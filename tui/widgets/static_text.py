"""A text of fixed size that costs nothing while it stays the same."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import TypeVar

from bot_console.tui.text.sanitize import sanitize
from rich.text import Text
from textual.geometry import Region
from textual.widgets import Static

W = TypeVar("W", bound="StaticText")


class StaticText(Static):
    """One line, or as many as its style allows. Control characters are visible; long lines end with an ellipsis."""

    DEFAULT_CSS = """
    StaticText { height: 1; padding: 0 1; color: $text-muted; background: $surface;
            text-wrap: nowrap; text-overflow: ellipsis; }
    """

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__("", id=id, markup=False)
        self._last_message: str | Text = ""
        self._lines: Sequence[Text] = ()
        self._other: Sequence[Region] = ()
        """The only regions to redraw in the next refresh; empty for the whole widget."""

    def show_text(self, what: str | Text) -> None:
        """Show a text without a layout, redrawing only changed lines."""
        message = sanitize(what) if isinstance(what, str) else what
        if message != self._last_message or (
            isinstance(message, Text) and message.spans != getattr(self._last_message, "spans", None)
        ):
            self._last_message = message
            self._other = self._differing(message)
            try:
                self.update(message, layout=False)
            finally:
                self._other = ()

    def show_or_hide(self, what: str | Text) -> None:
        """Show a text; hide the widget if the text is empty."""
        self.styles.display = None if what else "none"  # immediate; a class would take effect only when idle
        self.show_text(what)

    def show_whole(self, what: str, maximum: int) -> None:
        """Show a text in as many lines as it needs, up to `maximum`; the widget's style must wrap."""
        width = self.content_size.width
        console = self.app.console  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
        need = len(Text(sanitize(what)).wrap(console, width)) if width else 1
        height = min(max(need, 1), maximum)
        if self.styles.height is None or self.styles.height.value != height:
            self.styles.height = height
        self.show_text(what)

    def _differing(self, message: str | Text) -> Sequence[Region]:
        """The regions of the lines that have changed; empty if that is unknown."""
        width, height = self.size
        before, self._lines = self._lines, ()
        if isinstance(message, Text) and height > 1 and self.styles.text_wrap == "nowrap":
            self._lines = [*message.split("\n", allow_blank=True)][:height]
        if not before or not self._lines:
            return ()
        both = enumerate(zip_longest(before, self._lines))
        return [Region(0, y, width, 1) for y, (old, new) in both if old is None or new is None or not _same(old, new)]

    def refresh(self: W, *regions: Region, repaint: bool = True, layout: bool = False, recompose: bool = False) -> W:
        """Refresh like Textual, but if no regions are given, only the lines that have changed."""
        return super().refresh(*(regions or self._other), repaint=repaint, layout=layout, recompose=recompose)


def _same(old: Text, new: Text) -> bool:
    return old.plain == new.plain and old.spans == new.spans and old.style == new.style
