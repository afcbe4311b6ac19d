"""Which panes there are: their digits, titles and classes, imported when the app is composed."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bot_console.tui.panes.pane import Pane


@dataclass(frozen=True)
class PaneEntry:
    """A pane: its id (also the module's name), its class, the digit that jumps to it, and whether the overview has it."""

    id: str
    digit: str
    title: str
    class_name: str
    overview: bool = False
    short: str = ""
    """The title where there is little room; empty: the title."""

    def load(self) -> type[Pane]:
        """The class of the pane."""
        return getattr(importlib.import_module(f"bot_console.tui.panes.{self.id}"), self.class_name)


PANES = (
    PaneEntry("parameters", "1", "Parameters", "ParametersPane", overview=True, short="Params"),
    PaneEntry("logs", "2", "Logs", "LogsPane", overview=True),
    PaneEntry("graph", "3", "Graph", "GraphPane"),
    PaneEntry("plot", "4", "Plot", "PlotPane", overview=True),
    PaneEntry("world", "5", "World", "WorldPane", overview=True),
    PaneEntry("steering", "6", "Steering", "SteeringPane", short="Steer"),
    PaneEntry("profiles", "7", "Profiles", "ProfilesPane"),
    PaneEntry("launch", "8", "Launch", "LaunchPane"),
)
