"""What was open, filtered and selected in a pane is restored at the next start."""

from __future__ import annotations

import pytest
from bot_console.tui.panes.graph.pane import GraphPane
from bot_console.tui.panes.graph.view import Mode
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from piloting import Session, run
from samples import live


def current(session: Session) -> tuple[str, str]:
    row = session.pane(ParameterRows).current
    return row.node, row.parameter.name if row.parameter else ""


@pytest.mark.slow
def test_parameter_tree_is_restored_at_the_next_start() -> None:
    kept = {}

    async def leave(session: Session) -> None:
        await session.press("1", "slash")
        await session.paste("speed")
        await session.press("enter", "escape", "G", "left", "left", "g", "down", "down")
        assert current(session) == ("/robot_navigator", "enable_safety")
        pane = session.pane(ParametersPane)
        pane.on_unmount()
        kept["parameters"] = session.app.state_store.get("parameters")

    async def come_back(session: Session) -> None:
        session.app.state_store.put("parameters", kept["parameters"])
        pane = session.pane(ParametersPane)
        pane._chosen = False
        pane.on_mount()
        await session.press("1")
        assert current(session) == ("/robot_navigator", "enable_safety")
        assert any(row.folded and row.node == "/simulator" for row in session.pane(ParameterRows).rows)

    run(live(), leave)
    run(live(), come_back)
    assert kept["parameters"]["closed"]


def test_filter_and_form_of_the_graph_are_restored_and_escape_clears_a_filter() -> None:
    async def play(session: Session) -> None:
        session.app.state_store.put(
            "parameters", {"filter": "turn", "at": ["/robot_navigator", "turn_rate", "turn_rate"]}
        )
        session.pane(ParametersPane).on_mount()
        await session.press("1")
        assert "/turn" in session.text() and current(session) == ("/robot_navigator", "turn_rate")
        await session.press("escape")
        assert len(session.pane(ParameterRows).rows) > 5
        session.app.state_store.put("graph", {"mode": "LIST"})
        session.pane(GraphPane).on_mount()
        await session.press("3")
        assert session.pane(GraphPane).border_subtitle.startswith("List")
        assert "/cmd_vel_teleop" in session.text() and "(none) → " in session.text()

    run(live(), play)


@pytest.mark.slow
def test_graph_view_is_restored() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(GraphPane)
        await session.press("3", "m", "D")
        pane.on_unmount()
        kept = session.app.state_store.get("graph")
        session.app.state_store.put("graph", {"mode": "LIST"})
        pane.on_mount()
        await session.press("1", "3", "o")
        assert kept == {**kept, "mode": "NODES", "debug": True} and pane._view.mode is Mode.LIST

    run(live(), play)


def test_preselected_node_takes_precedence_over_restored_cursor() -> None:
    async def play(session: Session) -> None:
        session.app.state_store.put("parameters", {"filter": "turn", "closed": ["/simulator"]})
        pane = session.pane(ParametersPane)
        pane.on_mount()
        pane.go_to("/simulator")
        await session.press("1")
        assert current(session)[0] == "/simulator" and pane.words == ""

    run(live(), play)
