"""A straightforward screen: stock widgets of Textual over the same kind of data, ten times a second.

It has a table of parameters, a picture of the world, a curve, a log, a sparkline and a status line. `K<n>#` in that
line counts presses of `j`.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from typing import ClassVar

from rich.text import Text
from textual.app import App, ComposeResult
from textual.binding import BindingType
from textual.containers import Horizontal, Vertical
from textual.widgets import DataTable, Footer, RichLog, Sparkline, Static

HERTZ = 10
BLANK = "\u2800"


class StockScreen(App[None]):
    """Redraws everything that has changed, and sends it at once."""

    CSS = """
    Static, RichLog, DataTable { height: 1fr; }
    #status, Sparkline { height: 1; }
    Vertical { width: 1fr; }
    """
    BINDINGS: ClassVar[list[BindingType]] = [("j", "count", "Count")]

    def __init__(self) -> None:
        super().__init__()
        self.presses = self.step = 0
        self.speeds: deque[float] = deque([0.0] * 300, maxlen=300)

    def compose(self) -> ComposeResult:
        with Horizontal():
            with Vertical():
                yield DataTable[str]()
                yield RichLog(max_lines=1000)
            with Vertical():
                yield Static(id="world")
                yield Static(id="curve")
                yield Sparkline([])
        yield Static(id="status")
        yield Footer()

    def on_mount(self) -> None:
        table = self.query_one(DataTable)
        table.add_columns("parameter", "value")
        for number in range(20):
            table.add_row(f"parameter_{number}", str(number))
        table.focus()
        self.set_interval(1 / HERTZ, self.heartbeat)

    def heartbeat(self) -> None:
        self.step += 1
        at = self.step / HERTZ
        self.speeds.append(1 + math.sin(at / 3))
        world, curve = self.query_one("#world", Static), self.query_one("#curve", Static)
        world.update(
            picture(*world.size, lambda x, y: abs(math.hypot(x - 0.5, y - 0.5) - 0.4 + 0.05 * math.sin(at)) < 0.05)
        )
        speeds = list(self.speeds)
        curve.update(picture(*curve.size, lambda x, y: abs(1 - speeds[int(x * 299)] / 2 - y) < 0.05))
        self.query_one(Sparkline).data = speeds[-60:]
        if self.step % 5 == 0:
            line = Text.assemble(
                (time.strftime("%H:%M:%S "), "dim"), ("I ", "green"), f"robot_navigator step {self.step}"
            )
            self.query_one(RichLog).write(line)
        self.show_status()

    def action_count(self) -> None:
        self.presses += 1
        self.show_status()

    def show_status(self) -> None:
        self.query_one("#status", Static).update(
            f"K{self.presses}# asked {self.speeds[-1]:+.1f} m/s, {self.step} steps"
        )


def picture(width: int, height: int, filled: Callable[[float, float], bool]) -> Text:
    """Draw the filled parts as braille characters, with a colour for every character, as shaders have.

    Coordinates are from 0 to 1.
    """
    text = Text()
    for row in range(height):
        for column in range(width):
            inside = filled(column / width, row / height)
            text.append("\u28ff" if inside else BLANK, f"rgb({100 + column % 100},200,{100 + row})" if inside else "")
    return text


if __name__ == "__main__":
    StockScreen().run()
