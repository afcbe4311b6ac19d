"""The framed box that a screen over the panes consists of."""

from __future__ import annotations

from textual.containers import Vertical


class Box(Vertical):
    """Stands out from what is below it, and so do its lists and lines; the screen gives it its size."""

    DEFAULT_CSS = """
    Box { background: $panel; border: round $primary; padding: 0 1; }
    Box RowList { background: $panel; }
    Box Words { background: $panel; padding: 0; }
    """
