"""The console opens what the spellings of rqt ask for, at the start and by a line after the colon."""

from __future__ import annotations

from bot_console.tui.opening import Opening
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.panes.plot.pane import PlotPane
from piloting import Session, run
from samples import NEAREST, SPEED, live


def test_a_line_of_rqt_plot_replaces_the_curves_and_waits_for_what_is_not_there() -> None:
    async def play(session: Session) -> None:
        assert session.pane(PlotPane).paths != [NEAREST]
        await session.press(":")
        await session.type(f"ros2 run rqt_plot rqt_plot {NEAREST} /none/x")
        await session.press("enter")
        assert session.pane(PlotPane).display
        assert session.pane(PlotPane).paths == [NEAREST]
        assert "waits for /none/x" in session.text()
        assert not any(each[0] == "run" for each in session.console.asked)

    run(live(), play, (120, 40))


def test_every_number_of_a_topic_is_a_curve() -> None:
    async def play(session: Session) -> None:
        session.app.open(Opening("plot", (SPEED.rpartition("/")[0],)))
        await session.settle()
        assert SPEED in session.pane(PlotPane).paths
        assert "waits for" not in session.text()

    run(live(), play, (120, 40))


def test_a_node_is_gone_to() -> None:
    async def play(session: Session) -> None:
        session.app.open(Opening("parameters", node="/none"))
        await session.settle()
        assert "waits for /none" in session.text()
        session.app.open(Opening("parameters", node="/simulator"))
        await session.settle()
        row = session.pane(ParametersPane).query_one(ParameterRows).current
        assert row is not None and row.node == "/simulator"
        assert "waits for" not in session.text()

    run(live(), play)


def test_what_is_not_taken_over_is_told() -> None:
    async def play(session: Session) -> None:
        await session.press(":")
        await session.type("rqt --perspective-file mine.ini wrong")
        await session.press("enter")
        text = " ".join(session.text().split())
        assert "perspective mine.ini" in text
        assert "wrong is not taken over" in text

    run(live(), play, (120, 40))
