"""`FakeSights`: what the test says that the robot shows."""

from __future__ import annotations

from bot_console.tui.console.sights.frame_model import Frames
from bot_console.tui.console.sights.model import Diagnostics, Level, Picture, Status, Told


class FakeSights:
    """Shows what was put in."""

    def __init__(self) -> None:
        self.info = Diagnostics()
        self.shown = Picture()
        self.looking: tuple[str, int, int] = ("", 0, 0)
        self.tree = Frames()
        self.looked_at = False
        self.nodes_looked_at = False

    def diagnostics(self) -> Diagnostics:
        return self.info

    def look_at(self, topic: str, columns: int, rows: int) -> None:
        self.looking = (topic, columns, rows)

    def picture(self) -> Picture:
        return self.shown

    def look_at_frames(self, on: bool) -> None:
        self.looked_at = on

    def look_at_nodes(self, on: bool) -> None:
        self.nodes_looked_at = on

    def frames(self) -> Frames:
        return self.tree if self.looked_at else Frames()


def status(name: str, level: Level = Level.OK, message: str = "", heard: float = 100.0, **values: str) -> Status:
    """A status that has been so from the start."""
    told = (Told(1_700_000_000_000_000_000, level, message),)
    return Status(name, level, message, "robot", tuple(values.items()), heard, told)
