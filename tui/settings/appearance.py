"""The choices of a person for the look of the screen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from bot_console.tui.console.graph.hidden_names import TOOL_NAMES
from bot_console.tui.files.state_store import MemoryStore, StateStore
from bot_console.tui.layout.current_layout import Arrangement


@dataclass(frozen=True)
class Appearance:
    """Panes, colours, glyphs and keys; `notes` say which of a person's settings could not be applied."""

    arrangement: Arrangement = field(default_factory=Arrangement)
    theme: str = "dark"
    """A name of `theme.THEMES`."""
    plain: bool = False
    """Whether ASCII characters replace lines and braille."""
    keys: Mapping[str, str] = field(default_factory=dict[str, str])
    """The remapped keys, by the action ids of `keymap.TABLE`, which contains them already."""
    state_store: StateStore = field(default_factory=MemoryStore)
    """The store for what panes keep between runs."""
    notes: tuple[str, ...] = ()
    graph_hides: tuple[str, ...] = TOOL_NAMES
    """Patterns of the names of topics and nodes that the graph leaves out."""
