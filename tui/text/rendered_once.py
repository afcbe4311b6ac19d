"""What is worked out once for a width: Textual asks for the height of a text first, and then for the text."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.measure import Measurement
from rich.segment import Segment


class RenderedOnce:
    """A renderable that stays as it is, such as a long table."""

    def __init__(self, what: RenderableType) -> None:
        self._what = what
        self._width = -1
        self._segments: list[Segment] = []

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterable[Segment]:
        """Its segments, kept for the last width."""
        if options.max_width != self._width:
            self._width, self._segments = options.max_width, [*console.render(self._what, options)]
        return self._segments

    def __rich_measure__(self, console: Console, options: ConsoleOptions) -> Measurement:
        """How wide it may be."""
        return Measurement.get(console, options, self._what)
