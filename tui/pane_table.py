"""The table of panes: their keys, titles and classes, which are imported when the app is composed."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bot_console.tui.panes.pane import Pane


@dataclass(frozen=True)
class PaneEntry:
    """A pane: its id (also the name of its folder), the key that opens it (mostly a digit), and its class."""

    id: str
    key: str
    title: str
    class_name: str
    place: int = 9
    """Its place among the panes on the screen, from the upper left; Tab goes through them in this order."""
    short: str = ""
    """A shorter title for narrow places; empty: the same title."""

    def load(self) -> type[Pane]:
        """The class of the pane."""
        return getattr(importlib.import_module(f"bot_console.tui.panes.{self.id}.pane"), self.class_name)


PANES = (
    PaneEntry("parameters", "1", "Parameters", "ParametersPane", place=1, short="Param"),
    PaneEntry("logs", "2", "Logs", "LogsPane", place=5),
    PaneEntry("graph", "3", "Graph", "GraphPane", place=3),
    PaneEntry("plot", "4", "Plot", "PlotPane", place=4),
    PaneEntry("world", "5", "World", "WorldPane", place=2),
    PaneEntry("steering", "6", "Steering", "SteeringPane", short="Steer"),
    PaneEntry("profiles", "7", "Profiles", "ProfilesPane"),
    PaneEntry("launch", "8", "Launch", "LaunchPane"),
    PaneEntry("topics", "9", "Topics", "TopicsPane"),
    PaneEntry("history", "H", "History", "HistoryPane", short="Hist"),
    PaneEntry("diagnostics", "M", "Diagnostics", "DiagnosticsPane", short="Diag"),
    PaneEntry("alarms", "B", "Alarms", "AlarmsPane"),
    PaneEntry("images", "I", "Images", "ImagesPane", short="Img"),
)
