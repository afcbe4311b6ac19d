"""How the screen should look, as far as a person can choose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from bot_console.tui.kept import Kept, KeptHere
from bot_console.tui.layout.arrangement import Arrangement


@dataclass(frozen=True)
class Look:
    """Panes, colours, glyphs and keys, and lines that say which of a person's settings could not be applied."""

    arrangement: Arrangement = field(default_factory=Arrangement)
    theme: str = "dark"
    """A name of `theme.THEMES`."""
    plain: bool = False
    """Whether ASCII letters take the place of lines and braille."""
    keys: Mapping[str, str] = field(default_factory=dict[str, str])
    """Other keys for actions, by the ids of `keymap.TABLE`, in which they stand already."""
    kept: Kept = field(default_factory=KeptHere)
    """What the panes keep from run to run."""
    notes: tuple[str, ...] = ()
