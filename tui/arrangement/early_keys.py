"""Which keys can be handled before all panes exist: those that act on what is already visible."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from bot_console.tui.keymap import TABLE

if TYPE_CHECKING:
    from bot_console.tui.arrangement.stage import Stage
    from textual.app import App

AT_ONCE = {
    "app.help",
    "app.stop",
    "app.quit",
    "app.quit_now",
    "app.acknowledge",
    "app.theme",
    "app.glyphs",
    "app.redraw",
} | {each.id for scope in ("list", "overlay", "box", "help") for each in TABLE[scope]}
"""Actions on the focused pane, on an overlay, or on the app as a whole, by their ids.

Any other action may need a pane that does not exist yet: plotting a curve needs the plot.
"""
NEXT = ("app.next", "app.previous")
PANE = "pane('"


def panes_needed(app: App[None], stage: Stage, key: str) -> Sequence[str] | None:
    """The ids of the panes that must exist before a key is handled; None for all of them."""
    active = app.screen.active_bindings.get(key)
    if active is None:
        return None
    id, action = active.binding.id or "", active.binding.action
    if id in AT_ONCE or (id in NEXT and len(stage.visible()) > 1):
        return ()
    if active.node is app and action.startswith(PANE):
        return stage.visible_with(action.removeprefix(PANE).removesuffix("')"))
    return None
