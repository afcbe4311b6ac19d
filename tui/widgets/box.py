"""The framed box of a screen over the panes."""

from __future__ import annotations

from textual.containers import Vertical


class Box(Vertical):
    """A box whose background, also that of its lists and lines, differs from the panes below; the screen sizes it."""

    DEFAULT_CSS = """
    Box { background: $panel; border: round $primary; padding: 0 1; }
    Box RowList { background: $panel; }
    Box StaticText { background: $panel; padding: 0; }
    """
