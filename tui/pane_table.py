"""The table of panes: their keys, titles and classes, which are imported when the app is composed."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bot_console.tui.panes.pane import Pane


@dataclass(frozen=True)
class PaneEntry:
    """A pane: its id (also the name of its folder), its class, and the key that opens it, mostly a digit."""

    id: str
    digit: str
    title: str
    class_name: str
    place: int = 9
    """Its place among the panes on the screen, from the upper left; the overview fills its grid in this order."""
    overview: int = 0
    """The smallest overview that has it: 1 the usual one, 2 the one of wide terminals, 0 none."""
    short: str = ""
    """The title where there is little room; empty: the title."""

    def load(self) -> type[Pane]:
        """The class of the pane."""
        return getattr(importlib.import_module(f"bot_console.tui.panes.{self.id}.pane"), self.class_name)


PANES = (
    PaneEntry("parameters", "1", "Parameters", "ParametersPane", place=1, overview=1, short="Params"),
    PaneEntry("logs", "2", "Logs", "LogsPane", place=5, overview=1),
    PaneEntry("graph", "3", "Graph", "GraphPane", place=3, overview=2),
    PaneEntry("plot", "4", "Plot", "PlotPane", place=4, overview=1),
    PaneEntry("world", "5", "World", "WorldPane", place=2, overview=1),
    PaneEntry("steering", "6", "Steering", "SteeringPane", short="Steer"),
    PaneEntry("profiles", "7", "Profiles", "ProfilesPane"),
    PaneEntry("launch", "8", "Launch", "LaunchPane"),
    PaneEntry("topics", "9", "Topics", "TopicsPane"),
    PaneEntry("history", "H", "History", "HistoryPane", short="Hist"),
    PaneEntry("diagnostics", "M", "Diagnostics", "DiagnosticsPane", short="Diag"),
    PaneEntry("alarms", "B", "Alarms", "AlarmsPane"),
    PaneEntry("images", "I", "Images", "ImagesPane", short="Img"),
)
