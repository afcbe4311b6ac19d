"""The console opens what rqt's command lines ask for, at the start and after the colon."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.console.model import Endpoint, GraphInfo
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.panes.plot.pane import PlotPane
from piloting import Session, run
from samples import NEAREST, SPEED, empty, live

PAIR = ([59.0, 60.0], [1.0, 2.0])


def test_rqt_plot_line_replaces_curves_and_waits_for_missing_topics() -> None:
    async def play(session: Session) -> None:
        assert session.pane(PlotPane).paths != [NEAREST]
        await session.press(":")
        await session.paste(f"ros2 run rqt_plot rqt_plot {NEAREST} /none/x")
        await session.press("enter")
        assert session.pane(PlotPane).display
        assert session.pane(PlotPane).paths == [NEAREST]
        assert "waiting for /none/x" in session.text()
        assert not any(each[0] == "run" for each in session.console.asked)

    run(live(), play, (120, 40))


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        (
            ("/robot/speed", "/robot/distance"),
            "Waiting for /robot/speed, /robot/distance: the curve begins with the first",
        ),
        ((), "The plot shows numbers over time; there are no curves yet."),
    ],
)
def test_empty_plot_names_awaited_paths_or_the_key_to_press(wanted: tuple[str, ...], message: str) -> None:
    async def play(session: Session) -> None:
        session.app.open(Opening("plot", wanted))
        await session.settle()
        plot = session.pane(PlotPane)
        while plot.paths:
            await session.press("x")
        area = plot.region
        lines = [each[area.x + 1 : area.right - 1] for each in session.lines()[area.y + 1 : area.bottom - 1]]
        assert message in " ".join(" ".join(lines).split())

    run(empty(), play, (60, 20))


@pytest.mark.parametrize(
    "wanted",
    [
        *(pytest.param(each, marks=pytest.mark.slow) for each in ("/scan/ranges[2]", "max(/scan/ranges[4:8])")),
        "/tf/transforms[0].rotation.z - 1",
    ],
)
def test_unknown_path_is_plotted_once_its_topic_appears(wanted: str) -> None:
    console, launcher = live()
    console.plots.plottable = lambda: ()  # type: ignore[method-assign]
    console.series |= dict.fromkeys(
        ("/scan/ranges[2]", "/tf/transforms[0].rotation.z", "/scan/ranges[4:8].max()"), PAIR
    )
    there = console.snapshot().graph
    console.change(graph=GraphInfo(topics=(Endpoint("/rosout", ("rcl_interfaces/msg/Log",)),)))

    async def play(session: Session) -> None:
        session.app.open(Opening("plot", (wanted,)))
        await session.settle()
        assert f"waiting for {wanted}" in session.text()
        console.change(graph=replace(there, topics=(*there.topics, Endpoint("/tf", ("tf2_msgs/msg/TFMessage",)))))
        await session.settle()
        assert len(session.pane(PlotPane).paths) == 1
        assert "waiting for /" not in session.text()

    run((console, launcher), play, (120, 40))


@pytest.mark.parametrize(
    ("wanted", "path", "why"),
    [
        ("/scan/rangs[2]", "/scan/rangs[2]", "LaserScan has no field 'rangs'"),
        pytest.param("/scan + 1", "/scan", "name a field of /scan as well", marks=pytest.mark.slow),
    ],
)
def test_reason_for_an_unplottable_field_is_shown(wanted: str, path: str, why: str) -> None:
    async def play(session: Session) -> None:
        session.console.unplottable[path] = why
        session.app.open(Opening("plot", (wanted,)))
        await session.settle()
        assert f"waiting for {wanted}: {why}" in session.text()

    run(live(), play, (120, 40))


def test_topic_is_plotted_with_a_curve_per_number() -> None:
    async def play(session: Session) -> None:
        session.app.open(Opening("plot", (SPEED.rpartition("/")[0],)))
        await session.settle()
        assert SPEED in session.pane(PlotPane).paths
        assert "waiting for /" not in session.text()

    run(live(), play, (120, 40))


def test_preselected_node_is_selected() -> None:
    async def play(session: Session) -> None:
        session.app.open(Opening("parameters", node="/none"))
        await session.settle()
        assert "waiting for /none" in session.text()
        session.app.open(Opening("parameters", node="/simulator"))
        await session.settle()
        row = session.pane(ParametersPane).query_one(ParameterRows).current
        assert row is not None and row.node == "/simulator"
        assert "waiting for /" not in session.text()

    run(live(), play)


def test_ignored_options_are_reported() -> None:
    async def play(session: Session) -> None:
        await session.press(":")
        await session.paste("rqt --perspective-file mine.ini wrong")
        await session.press("enter")
        text = " ".join(each.message for each in session.app._notifications)
        assert "perspective mine.ini" in text
        assert "wrong is ignored" in text

    run(live(), play, (120, 40))
