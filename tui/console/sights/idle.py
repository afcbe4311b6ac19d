"""`Sights` while there is no ROS system to look at: nothing is seen, and it says why."""

from __future__ import annotations

from bot_console.tui.console.sights.frame_model import Frames
from bot_console.tui.console.sights.model import Diagnostics, Picture


class IdleSights:
    """Says why nothing is seen."""

    def __init__(self, why: str) -> None:
        self._diagnostics = Diagnostics(problem=why)
        self._picture = Picture(problem=why)
        self._frames = Frames(problem=why)

    def diagnostics(self) -> Diagnostics:
        """None, and why."""
        return self._diagnostics

    def look_at(self, topic: str, columns: int, rows: int) -> None:
        """Nothing comes."""

    def picture(self) -> Picture:
        """None, and why."""
        return self._picture

    def look_at_frames(self, on: bool) -> None:
        """There are none."""

    def look_at_nodes(self, on: bool) -> None:
        """There are none."""

    def frames(self) -> Frames:
        """None, and why."""
        return self._frames
