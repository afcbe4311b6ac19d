"""Start and stop the robot by two buttons; the status says what came of it."""

from __future__ import annotations

from concurrent.futures import Future

from bot_console.tui.console.model import ConsoleSnapshot, SetOutcome
from bot_console.tui.console.protocol import Console
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widgets import Button, Label

NODE = "/robot_navigator"
FAST, SLOW = 1.0, 0.1
"""Speeds (m/s): what the robot starts with, and the least that its node takes."""


class MyRobotControl(Vertical):
    """A widget that is given the console: it sets a parameter as `ros2 param set` does, and locks or releases."""

    TITLE = "My robot"
    HELP = "Start Robot lets it drive at 1 m/s; Stop Robot locks it."

    def __init__(self, console: Console) -> None:
        super().__init__()
        self.system = console
        self._status = Label("Robot Status: OK", markup=False)

    def compose(self) -> ComposeResult:
        """Status and buttons."""
        yield self._status
        yield Button("Start Robot", id="start")
        yield Button("Stop Robot", id="stop")

    def on_button_pressed(self, event: Button.Pressed) -> None:
        """Set the speed, and lock the robot or let it go."""
        stop = event.button.id == "stop"
        self.system.drive.stop(stop, "my_robot_control")
        answer = self.system.parameters.set(NODE, {"max_speed": SLOW if stop else FAST})
        word = "Stopped" if stop else "Running"
        # The answer comes in another thread than the one that draws.
        answer.add_done_callback(lambda done: self.app.call_later(self._report, word, done))

    def _report(self, word: str, done: Future[tuple[SetOutcome, ...]]) -> None:
        error = done.exception()
        refused = [] if error else [each.reason for each in done.result() if each.reason]
        self._status.update(f"Robot Status: {word}" + (f" ({error or refused[0]})" if error or refused else ""))

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Called with each new snapshot while the pane is seen: nothing of it is needed here."""
