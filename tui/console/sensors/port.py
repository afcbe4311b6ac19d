"""The port for a robot's sensors: diagnostics, images and frames. Standard library only."""

from __future__ import annotations

from typing import Protocol

from bot_console.tui.console.sensors.camera_image import Picture
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics
from bot_console.tui.console.sensors.frames import Frames


class Sensors(Protocol):
    """Provides a robot's diagnostics, images and frames."""

    def diagnostics(self) -> Diagnostics:
        """The newest diagnostics; the same object until a status changes."""
        ...

    def watch_image(self, topic: str, columns: int, rows: int) -> None:
        """Subscribe to this image topic only, and scale images to a size in pixels; an empty name ends that."""
        ...

    def picture(self) -> Picture:
        """The newest image; the same object until there is another one."""
        ...

    def watch_frames(self, on: bool) -> None:
        """Start or stop listening to `/tf` and `/tf_static`."""
        ...

    def frames(self) -> Frames:
        """The frames received while listening."""
        ...
