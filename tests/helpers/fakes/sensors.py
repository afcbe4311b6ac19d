"""`FakeSensors`: sensor data set by the test."""

from __future__ import annotations

from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.sensors.camera_image import Picture
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics, Level, ReportedStatus, Status
from bot_console.tui.console.sensors.frames import Frames


class FakeSensors:
    """Reports the data it was given."""

    def __init__(self) -> None:
        self.info = Diagnostics()
        self.shown = Picture()
        self.watching: tuple[str, int, int] = ("", 0, 0)
        self.tree = Frames()
        self.watched = False
        self.watched_nodes: set[str] = set()
        self.written_launches: list[str] = []
        self.transitions: list[tuple[str, str]] = []
        self.transition_answer = Answer(True, "it is inactive now")

    def diagnostics(self) -> Diagnostics:
        return self.info

    def watch_image(self, topic: str, columns: int, rows: int) -> None:
        self.watching = (topic, columns, rows)

    def picture(self) -> Picture:
        return self.shown

    def watch_frames(self, on: bool) -> None:
        self.watched = on

    def watch_nodes(self, on: bool, requester: str) -> None:
        self.watched_nodes = self.watched_nodes - {requester} | ({requester} if on else set())

    def change_state(self, node: str, transition: str) -> Future[Answer]:
        self.transitions.append((node, transition))
        return done(self.transition_answer)

    def write_launch(self, path: str) -> Answer:
        self.written_launches.append(path)
        return Answer(True, f"{path}: 2 programs")

    def frames(self) -> Frames:
        return self.tree if self.watched else Frames()


def status(
    name: str, level: Level = Level.OK, message: str = "", last_received: float = 100.0, **values: str
) -> Status:
    """A status that has not changed since the start."""
    reported = (ReportedStatus(1_700_000_000_000_000_000, level, message),)
    return Status(name, level, message, "robot", tuple(values.items()), last_received, reported)
