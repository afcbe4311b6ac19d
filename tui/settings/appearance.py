"""How the screen should look, as far as a person can choose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from bot_console.tui.console.graph.connections import TOOL_NAMES
from bot_console.tui.files.state_store import MemoryStore, StateStore
from bot_console.tui.layout.current_layout import Arrangement


@dataclass(frozen=True)
class Appearance:
    """Panes, colours, glyphs and keys, and lines that say which of a person's settings could not be applied."""

    arrangement: Arrangement = field(default_factory=Arrangement)
    theme: str = "dark"
    """A name of `theme.THEMES`."""
    plain: bool = False
    """Whether ASCII letters take the place of lines and braille."""
    keys: Mapping[str, str] = field(default_factory=dict[str, str])
    """Other keys for actions, by the ids of `keymap.TABLE`, in which they stand already."""
    state_store: StateStore = field(default_factory=MemoryStore)
    """The store for what panes keep from run to run."""
    notes: tuple[str, ...] = ()
    graph_hides: tuple[str, ...] = TOOL_NAMES
    """Patterns of the names of topics and nodes that the graph leaves out."""
