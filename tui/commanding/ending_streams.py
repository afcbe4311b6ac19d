"""Choosing which of the running command lines below the panes to stop."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.widgets.prompt.question import Choice, Option
from bot_console.tui.widgets.streams.panel import StreamPanel
from bot_console.tui.widgets.streams.panels import StreamPanels

ALL = "all"


def which_stream(streams: StreamPanels) -> Choice:
    """Ask which line to stop; if it has ended meanwhile, no other is stopped instead."""
    offered = {str(number): each for number, each in enumerate(streams.panels, 1)}

    def find(typed: str) -> Sequence[Option]:
        options = [Option(f"{number} {each.line}", each.state, number) for number, each in offered.items()]
        options.append(Option("all of them", value=ALL))
        named = [each for each in options if each.value == typed.strip()]
        return named or [each for each in options if all(word in each.title for word in typed.split())]

    def end(chosen: str) -> None:
        panels: Sequence[StreamPanel] = [*offered.values()] if chosen == ALL else [offered[chosen]]
        for each in panels:
            streams.end(each)

    return Choice(
        "End which line?", end, find=find, hint="its number, or words of it", empty="No line has these words."
    )
