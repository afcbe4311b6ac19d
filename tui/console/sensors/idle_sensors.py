"""`Sensors` while there is no ROS system: there is no data, and the reason why."""

from __future__ import annotations

from bot_console.tui.console.sensors.frame_model import Frames
from bot_console.tui.console.sensors.model import Diagnostics, Picture


class IdleSensors:
    """Says why there is no data."""

    def __init__(self, why: str) -> None:
        self._diagnostics = Diagnostics(problem=why)
        self._picture = Picture(problem=why)
        self._frames = Frames(problem=why)

    def diagnostics(self) -> Diagnostics:
        """None, with the reason."""
        return self._diagnostics

    def watch_image(self, topic: str, columns: int, rows: int) -> None:
        """Do nothing."""

    def picture(self) -> Picture:
        """None, with the reason."""
        return self._picture

    def watch_frames(self, on: bool) -> None:
        """Do nothing."""

    def watch_nodes(self, on: bool) -> None:
        """Do nothing."""

    def frames(self) -> Frames:
        """None, with the reason."""
        return self._frames
