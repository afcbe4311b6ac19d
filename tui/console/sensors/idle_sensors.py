"""`Sights` while there is no ROS system to look at: nothing is seen, and it says why."""

from __future__ import annotations

from bot_console.tui.console.sensors.frame_model import Frames
from bot_console.tui.console.sensors.model import Diagnostics, Picture


class IdleSensors:
    """Says why nothing is seen."""

    def __init__(self, why: str) -> None:
        self._diagnostics = Diagnostics(problem=why)
        self._picture = Picture(problem=why)
        self._frames = Frames(problem=why)

    def diagnostics(self) -> Diagnostics:
        """None, and why."""
        return self._diagnostics

    def watch_image(self, topic: str, columns: int, rows: int) -> None:
        """Nothing comes."""

    def picture(self) -> Picture:
        """None, and why."""
        return self._picture

    def watch_frames(self, on: bool) -> None:
        """There are none."""

    def watch_nodes(self, on: bool) -> None:
        """There are none."""

    def frames(self) -> Frames:
        """None, and why."""
        return self._frames
