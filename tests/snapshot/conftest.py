"""Keeps the settings of the person who runs the tests out of the pictures."""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest
from bot_console.tui.panes.alarms.pane import AlarmsPane
from bot_console.tui.panes.diagnostics.pane import DiagnosticsPane
from bot_console.tui.panes.images.pane import ImagesPane
from bot_console.tui.panes.launch.pane import LaunchPane
from bot_console.tui.panes.logs.pane import LogsPane
from piloting import Clock
from rest import at_rest
from textual.widgets import Input


@pytest.fixture(autouse=True)
def plain_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TZ", "UTC")
    time.tzset()
    for each in (DiagnosticsPane, AlarmsPane, ImagesPane, LaunchPane, LogsPane):
        monkeypatch.setattr(each, "clock", staticmethod(Clock()))
    monkeypatch.setattr(Input, "_toggle_cursor", lambda self: None)


@pytest.fixture(autouse=True)
def pictures_are_taken_at_rest() -> Iterator[None]:
    with at_rest(is_scripted=True):
        yield
