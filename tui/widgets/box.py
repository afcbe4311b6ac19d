"""The framed box that a screen over the panes consists of."""

from __future__ import annotations

from textual.containers import Vertical


class Box(Vertical):
    """A box set off from what is below it, including its lists and lines; the screen sets its size."""

    DEFAULT_CSS = """
    Box { background: $panel; border: round $primary; padding: 0 1; }
    Box RowList { background: $panel; }
    Box StaticText { background: $panel; padding: 0; }
    """
