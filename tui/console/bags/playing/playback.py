"""The port for playing the bag that a console shows. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.text.counted import counted


@dataclass(frozen=True, slots=True)
class PlaybackState:
    """The position and settings of a player; times are in ns since the epoch."""

    position: int
    begin: int
    end: int
    rate: float = 1.0
    """Seconds of the bag that pass in one second."""
    paused: bool = True
    loop: bool = False
    published: int = 0
    """Number of messages published so far."""
    problem: str = ""
    """Why it cannot play; empty if it can."""

    def text(self) -> str:
        """The state on one line: `⏸ paused 12.3 / 60.0 s ×1 loop 230 messages`."""
        if self.problem:
            return self.problem
        at, whole = (self.position - self.begin) / 1e9, (self.end - self.begin) / 1e9
        words = ["⏸ paused " if self.paused else "▶ playing", f"{at:.1f} / {whole:.1f} s", f"×{self.rate:.3g}"]
        return "  ".join([*words, *(["loop"] if self.loop else []), counted(self.published, "message")])


class Playback(Protocol):
    """A player of one bag, which publishes nothing until it is asked to play or to step."""

    @property
    def state(self) -> PlaybackState:
        """The position and settings of the player."""
        ...

    def toggle(self) -> str:
        """Play or pause; at the end, play from the start. Returns a warning to show once, or an empty text."""
        ...

    def step(self) -> str:
        """Publish the next message, and pause. Returns a warning as `toggle` does."""
        ...

    def seek(self, stamp: int) -> None:
        """Continue at a time of the bag (ns since the epoch)."""
        ...

    def change_rate(self, factor: float) -> None:
        """Multiply the playback rate by a factor."""
        ...

    def toggle_loop(self) -> None:
        """Toggle whether playing starts again at the end of the bag."""
        ...

    def close(self) -> None:
        """Stop playing."""
        ...
