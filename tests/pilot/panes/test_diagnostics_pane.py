"""Diagnostics: the tree, its faults, stale entries, and the details of one status."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics, Level
from bot_console.tui.panes.diagnostics.pane import DiagnosticsPane
from bot_console.tui.panes.diagnostics.table import StatusRows
from fakes.sensors import status
from piloting import Session, run
from samples import live


def titles(session: Session) -> list[str]:
    return [each.title for each in session.pane(StatusRows).rows]


def test_tree_names_levels_and_propagates_the_worst() -> None:
    async def play(session: Session) -> None:
        await session.press("M")
        lines = session.lines()
        assert any("motors" in each and "✗ ERROR" in each and "1 of 3 OK" in each for each in lines)
        assert any("camera" in each and "◌ STALE" in each and "10 s" in each for each in lines)
        await session.press("G")
        assert "nearest  1.2" in session.text() and "was" in session.text()
        await session.press("g", "down", "enter")
        assert titles(session)[1:3] == ["motors", "safety_monitor: velocity"], "enter closes a row with children"
        await session.press("right", "down", "down", "enter")
        assert "temperature  71 C" in session.text() and "hardware robot" in session.text()

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_absence_of_diagnostics_is_explained_in_full() -> None:
    async def play(session: Session) -> None:
        session.console.sensors.info = Diagnostics()
        await session.press("M")
        session.pane(DiagnosticsPane).tick()
        await session.settle()
        message = " ".join(session.text().replace("│", " ").split())
        assert "no node publishes diagnostics yet (diagnostic_msgs/msg/DiagnosticArray)." in message

    run(live(), play, (120, 40))


def test_new_status_is_shown_and_silent_one_becomes_stale() -> None:
    async def play(session: Session) -> None:
        await session.press("M", "w")
        assert "safety_monitor: velocity" not in titles(session) and "2 of 5" not in session.text()
        pane = session.pane(DiagnosticsPane)
        session.console.sensors.info = Diagnostics((status("arm", Level.ERROR, "broken", last_received=100.0),))
        pane.clock.now += 0.4
        pane.tick()
        assert "arm" not in titles(session), "not before the timeout"
        pane.clock.now += 0.2
        pane.tick()
        await session.settle()
        assert "broken" in session.text()
        pane.clock.now += 5.0
        pane.tick()
        await session.settle()
        assert "◌ STALE" in session.text() and "it was ERROR" in session.text()
        fresh = replace(session.console.sensors.info.statuses[0], last_received=pane.clock.now, level=Level.OK)
        session.console.sensors.info = Diagnostics((fresh,))
        pane.clock.now += 0.5
        pane.tick()
        await session.settle()
        assert "All is OK." in session.text()

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_rows_are_filtered_and_folded() -> None:
    async def play(session: Session) -> None:
        await session.press("M", "slash")
        await session.type("warm")
        await session.press("enter")
        assert titles(session) == ["motors", "left", "driver"] and "1 of 5" in session.text()
        await session.press("escape", "C")
        assert titles(session) == ["camera", "motors", "safety_monitor: velocity"]
        await session.press("C")
        assert len(titles(session)) == 8

    run(live(), play)


@pytest.mark.slow
def test_mouse_selects_opens_and_folds_rows() -> None:
    async def play(session: Session) -> None:
        await session.press("M")
        assert await session.pilot.click(StatusRows, offset=(10, 3))
        await session.settle()
        assert session.pane(StatusRows).current.title == "driver"
        await session.pilot.click(StatusRows, offset=(10, 3))
        await session.settle()
        assert "temperature" in session.text() and len(session.app.screen_stack) == 2
        await session.press("escape")
        await session.pilot.click(StatusRows, offset=(0, 1))
        await session.settle()
        assert titles(session) == ["camera", "motors", "safety_monitor: velocity"], "the fold mark closes at once"

    run(live(), play, (100, 30))
