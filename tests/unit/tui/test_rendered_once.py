"""What is worked out once for a width."""

from __future__ import annotations

from collections.abc import Iterator

from bot_console.tui.text.rendered_once import RenderedOnce
from rich.console import Console, ConsoleOptions
from rich.measure import Measurement
from rich.segment import Segment
from rich.table import Table

CONSOLE = Console(width=40, color_system="truecolor")


class Counted:
    """Says how wide it was drawn, and counts how often."""

    def __init__(self) -> None:
        self.widths: list[int] = []

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Segment]:
        self.widths.append(options.max_width)
        yield Segment(str(options.max_width))


def test_it_is_drawn_once_for_a_width_and_anew_for_another() -> None:
    drawn = Counted()
    once = RenderedOnce(drawn)
    texts = [CONSOLE.render_lines(once, CONSOLE.options.update(width=width)) for width in (30, 30, 20, 20)]
    assert drawn.widths == [30, 20]
    assert ["".join(each.text for each in lines[0]).strip() for lines in texts] == ["30", "30", "20", "20"]


def test_a_table_looks_and_measures_as_without() -> None:
    table = Table.grid(padding=(0, 2))
    table.add_column(style="bold", justify="right", min_width=12)
    table.add_column()
    table.add_row("a", "word " * 20)
    options = CONSOLE.options
    assert CONSOLE.render_lines(RenderedOnce(table), options) == CONSOLE.render_lines(table, options)
    assert Measurement.get(CONSOLE, options, RenderedOnce(table)) == Measurement.get(CONSOLE, options, table)
