"""The plot: curves by path, pause, window, gaps, files."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from bot_console.tui.panes.plot.pane import PlotPane
from piloting import Session, run
from samples import LIMIT, NEAREST, SPEED, empty, faulty, live


def plot(session: Session) -> PlotPane:
    return session.pane(PlotPane)


def test_speed_and_its_limit_are_plotted_from_the_start() -> None:
    async def play(session: Session) -> None:
        await session.press("4")
        assert plot(session).paths == [SPEED, LIMIT]
        text = session.text()
        assert "▲" in text and "✗" in text, "a change and a refusal are marked"
        assert "min 0.2" in text and "-30s" in text

    run(live(), play, (120, 40))


def test_a_curve_is_added_by_its_path_with_completion_and_removed() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "a")
        await session.type("telemetry")
        await session.press("right", "enter")
        assert plot(session).paths == [SPEED, LIMIT, NEAREST]
        await session.press("x")
        assert plot(session).paths == [SPEED, LIMIT]
        assert ("unwatch", NEAREST) in session.console.asked
        await session.press("X")
        assert plot(session).paths == [] and "Press a" in session.text()

    run(live(), play)


def test_what_cannot_be_plotted_is_refused_with_the_reason() -> None:
    async def play(session: Session) -> None:
        session.console.unplottable["/scan"] = "name a field of /scan as well, for instance /scan/range_max"
        await session.press("4", "a")
        await session.type("scan")
        await session.press("enter")
        assert "name a field of /scan" in " ".join(session.text().split())
        assert "/scan" not in plot(session).paths

    run(live(), play, (120, 40))


def test_a_parameter_is_plotted_from_the_parameter_pane() -> None:
    async def play(session: Session) -> None:
        path = "/robot_navigator:detection_threshold"
        session.console.series[path] = ([1.0], [100.0])
        await session.press("1", "down", "p")
        assert path in plot(session).paths
        assert plot(session).display

    run(live(), play)


def test_pausing_holds_the_picture_and_counts_what_comes() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "space")
        before = session.lines()[2:14]
        times, values = session.console.series[SPEED]
        times += [61.0 + at / 10 for at in range(50)]
        values += [2.0] * 50
        plot(session).tick()
        await session.settle()
        assert "paused, 50 new" in session.text()
        assert session.lines()[2:14] == before
        await session.press("space")
        assert session.lines()[2:14] != before

    run(live(), play)


def test_the_window_grows_and_shrinks_and_limits_can_be_given() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "minus")
        assert "60 s" in session.text()
        await session.press("plus", "plus")
        assert "10 s" in session.text()
        await session.press("y")
        await session.type("3 1")
        await session.press("enter")
        assert "smaller one" in session.text()
        await session.press("backspace", "backspace", "backspace")
        await session.type("0 4")
        await session.press("enter")
        assert "y 0 .. 4" in session.text() and " 4 ┤" in session.text()

    run(live(), play, (100, 30))


def test_values_that_are_no_numbers_leave_a_gap_and_are_counted() -> None:
    system = live()
    system[0].series[SPEED][1][400:600] = [math.nan] * 100 + [math.inf] * 50 + [-math.inf] * 50

    async def play(session: Session) -> None:
        await session.press("4")
        assert "200 not finite" in session.text()

    run(system, play, (120, 40))


def test_a_curve_without_any_number_says_so() -> None:
    async def play(session: Session) -> None:
        await session.press("4")
        assert "no numbers in this window" in session.text()

    run(faulty(), play, (120, 40))


def test_strips_show_one_trace_below_each_name() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "f")
        text = session.text()
        assert SPEED in text and LIMIT in text and "┤" not in text

    run(live(), play, (100, 30))


def test_samples_and_picture_are_saved(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        for key, name in (("e", "p.csv"), ("S", "p.html"), ("S", "p.txt")):
            await session.press("4", key)
            session.app.focused.value = str(tmp_path / name)
            await session.press("enter")
        await session.press("e")
        session.app.focused.value = tmp_path.anchor
        await session.press("enter")
        assert "is a folder" in session.text()

    run(live(), play, (100, 30))
    rows = list(csv.reader((tmp_path / "p.csv").open()))
    assert rows[0] == ["series", "time", "value"] and len(rows) == 1 + 900 + 2
    assert "<" in (tmp_path / "p.html").read_text()
    assert any(0x2800 < ord(letter) < 0x2900 for letter in (tmp_path / "p.txt").read_text())


def test_an_empty_plot_says_what_to_do() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "x", "X", "space", "plus", "left", "right", "f", "K", "up", "down")
        assert "Press a" in session.text()

    run(empty(), play)
