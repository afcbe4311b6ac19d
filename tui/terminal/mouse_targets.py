"""Keeps the mouse from finding widgets that have been removed since the screen was composed.

When a mouse button goes down, Textual (8.2) looks for text to select there, and fails at a widget without a parent,
such as a notification that the first click of two has removed. That would end the app.
"""

from __future__ import annotations

from typing import Any, cast

from textual.geometry import Offset
from textual.widget import Widget


class MouseTargets:
    """A mixin for screens; it is not a widget, so that style sheets match the same classes as without it."""

    def get_widget_and_offset_at(self, x: int, y: int) -> tuple[Widget | None, Offset | None]:
        """The widget at a position, and the position within its content; none for one that was removed."""
        at: tuple[Widget | None, Offset | None] = cast(Any, super()).get_widget_and_offset_at(x, y)
        is_there = at[0] is None or at[0] is cast(Any, self) or at[0].parent is not None
        return at if is_there else (None, None)
