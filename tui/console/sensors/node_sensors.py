"""The port for sensor data: diagnostics, images and frames, received by the console's node."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sensors.camera_image import Picture
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics
from bot_console.tui.console.sensors.frames import Frames

if TYPE_CHECKING:
    from bot_console.tui.console.sensors.diagnostics_watch import DiagnosticsWatch
    from bot_console.tui.console.sensors.frames_watch import FramesWatch
    from bot_console.tui.console.sensors.image_watch import ImageWatch
    from rclpy.node import Node


class NodeSensors:
    """The robot's sensor data. Methods may be called from any thread; the executor does the work."""

    _diagnostics: DiagnosticsWatch | None = None
    _images: ImageWatch
    _frames: FramesWatch
    """Exist after `attach`, like `_diagnostics`."""

    def __init__(self, gate: Gate, graph: Callable[[], GraphInfo]) -> None:
        self._gate = gate
        self._graph = graph
        self._nothing: tuple[Diagnostics, Picture, Frames] = Diagnostics(), Picture(), Frames()

    def attach(self, node: Node) -> None:
        """Create the watches, once the system has been reached."""
        from bot_console.tui.console.sensors.diagnostics_watch import DiagnosticsWatch
        from bot_console.tui.console.sensors.frames_watch import FramesWatch
        from bot_console.tui.console.sensors.image_watch import ImageWatch

        self._images = ImageWatch(node)
        self._frames = FramesWatch(node)
        self._diagnostics = DiagnosticsWatch(node)

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        if self._diagnostics is not None:
            self._diagnostics.follow(graph)
            self._images.follow(graph)
            self._frames.follow(graph)

    def _unreached_values(self) -> tuple[Diagnostics, Picture, Frames]:
        """Before the system is reached: nothing, with the reason; the same objects until the reason changes."""
        why = self._gate.unreached
        if self._nothing[0].problem != why:
            self._nothing = Diagnostics(problem=why), Picture(problem=why), Frames(problem=why)
        return self._nothing

    def diagnostics(self) -> Diagnostics:
        """The latest diagnostics."""
        return self._diagnostics.diagnostics() if self._diagnostics else self._unreached_values()[0]

    def watch_image(self, topic: str, columns: int, rows: int) -> None:
        """Receive the images of a topic."""
        self._gate.run_when_open(lambda: self._images.watch_image(topic, columns, rows, self._graph()))

    def picture(self) -> Picture:
        """The newest image."""
        return self._images.picture() if self._diagnostics else self._unreached_values()[1]

    def watch_frames(self, on: bool) -> None:
        """Start or stop listening to `/tf` and `/tf_static`."""
        self._gate.run_when_open(lambda: self._frames.poll(on, self._graph()))

    def frames(self) -> Frames:
        """The frames received while listening."""
        return self._frames.frames() if self._diagnostics else self._unreached_values()[2]
