"""The plot: curves by path, pause, window, gaps, files."""

from __future__ import annotations

import csv
import math
from datetime import datetime
from pathlib import Path
from xml.etree import ElementTree

import pytest
from bot_console.tui.panes.plot.pane import PlotPane
from fakes.console import START
from piloting import Session, run
from samples import LIMIT, NEAREST, SPEED, live
from textual.widgets import Input


def plot(session: Session) -> PlotPane:
    return session.pane(PlotPane)


def test_speed_and_its_limit_are_plotted_by_default() -> None:
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
        await session.paste("telemetry")
        await session.press("enter")
        assert plot(session).paths == [SPEED, LIMIT, NEAREST]
        await session.press("x")
        assert plot(session).paths == [SPEED, LIMIT]
        assert ("unwatch", NEAREST) in session.console.asked
        await session.press("X")
        assert plot(session).paths == [] and "a  Add /topic" in session.text()

    run(live(), play)


def test_curve_that_does_not_appear_is_explained_once_and_can_be_removed() -> None:
    sum_of_message = f"{SPEED} + /scan"

    async def play(session: Session) -> None:
        session.console.unplottable["/scan"] = "name a field of /scan as well, for instance /scan/range_max"
        pane = plot(session)
        await session.press("4", "X")
        pane.expect([sum_of_message, "/nowhere"])
        session.console.change()
        session.console.change()
        await session.settle()
        assert "for instance /scan/range_max" in " ".join(session.text().split()) and "/nowhere" in session.text()
        await session.press("x")
        assert "/nowhere" not in session.text() and "waiting for" in session.text().lower()
        await session.press("x")
        assert "a  Add /topic" in session.text()
        pane.expect(["/nowhere"])
        session.console.change()
        await session.press("X")
        assert "a  Add /topic" in session.text()

    run(live(), play, (80, 24))


@pytest.mark.slow
def test_unplottable_path_is_rejected_with_a_reason() -> None:
    async def play(session: Session) -> None:
        session.console.unplottable["/scan"] = "name a field of /scan as well, for instance /scan/range_max"
        await session.press("4", "a")
        await session.paste("/scan")
        await session.press("enter")
        assert "name a field of /scan" in " ".join(session.text().split())
        assert "/scan" not in plot(session).paths

    run(live(), play, (120, 40))


@pytest.mark.parametrize(
    "typed",
    ["sine(/a/x)", *(pytest.param(each, marks=pytest.mark.slow) for each in (f"{LIMIT} +", f"{NEAREST}, nonsense"))],
)
def test_wrong_expression_stays_to_be_corrected(typed: str) -> None:
    async def play(session: Session) -> None:
        await session.press("4", "a")
        await session.paste(typed)
        await session.press("enter")
        assert session.app.screen.query_one(Input).value == typed
        assert len(session.app._notifications) == 0, "the box shows the reason"
        await session.press("ctrl+u")
        await session.paste(f"{SPEED} * 2")
        await session.press("enter")
        assert f"{SPEED} * 2" in plot(session).paths and len(session.app.screen_stack) == 1

    run(live(), play)


def test_a_parameter_is_plotted_from_the_parameter_pane() -> None:
    async def play(session: Session) -> None:
        path = "/robot_navigator:detection_threshold"
        session.console.series[path] = ([1.0], [100.0])
        await session.press("1", "home", "down", "p")
        assert path in plot(session).paths
        assert plot(session).display

    run(live(), play)


def test_a_topic_with_only_stamps_to_plot_gives_a_hint_about_parameters() -> None:
    async def play(session: Session) -> None:
        await session.press("4")
        stamp = "/parameter_events/stamp.nanosec"
        session.console.series[stamp] = ([1.0], [100.0])
        session.console.series["/odom/header.stamp.sec"] = ([1.0], [100.0])
        assert plot(session).add("/odom/header.stamp.sec")
        await session.settle()
        assert "/node:param" not in session.text(), "it has other numbers"
        assert plot(session).add(stamp)
        await session.settle()
        assert "/node:param." in session.text()

    run(live(), play)


def test_pausing_freezes_the_picture_and_counts_new_samples() -> None:
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
        await session.press("greater_than_sign")
        low, high = session.pane(PlotPane)._timeline.limits
        assert high - low == pytest.approx(2.0) and "y 0 .. 4" not in session.text()
        await session.press("less_than_sign")
        assert "y 0 .. 4" in session.text()
        await session.press("T")
        await session.paste("> 0.1")
        await session.press("enter")
        assert f"! {SPEED} > 0.1" in session.text()

    run(live(), play, (100, 30))


def test_nan_values_leave_a_gap_and_are_counted() -> None:
    system = live()
    system[0].series[SPEED][1][400:600] = [math.nan] * 100 + [math.inf] * 50 + [-math.inf] * 50

    async def play(session: Session) -> None:
        await session.press("4")
        assert "200 not finite" in session.text()

    run(system, play, (120, 40))


def test_strips_show_one_trace_below_each_name() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "f")
        text = session.text()
        assert SPEED in text and LIMIT in text and "┤" not in text

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_picture_is_saved_as_it_is_on_the_screen(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("4")
        for name in ("p.html", "p.txt"):
            await save(session, "S", tmp_path / name)

    run(live(), play, (100, 30))
    assert "<" in (tmp_path / "p.html").read_text()
    assert any(0x2800 < ord(character) < 0x2900 for character in (tmp_path / "p.txt").read_text())


async def save(session: Session, key: str, file: Path) -> None:
    await session.press(key)
    session.app.focused.value = str(file)
    await session.press("enter")


def test_samples_and_picture_are_saved(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("4")
        await save(session, "e", tmp_path / "p.csv")
        await save(session, "S", tmp_path / "p.svg")
        await session.press("e")
        session.app.focused.value = tmp_path.anchor
        await session.press("enter")
        assert "is a folder" in session.text()

    run(live(), play, (100, 30))
    rows = list(csv.reader((tmp_path / "p.csv").open()))
    assert rows[0] == ["series", "time", "seconds", "value"] and len(rows) == 1 + 600 + 1, "only the visible samples"
    at = datetime.fromisoformat(rows[1][1])
    assert at.tzinfo is not None and at.timestamp() == pytest.approx(float(rows[1][2])) == pytest.approx(
        START / 1e9 - 30
    )
    words = [each.text for each in ElementTree.parse(tmp_path / "p.svg").iter("{http://www.w3.org/2000/svg}text")]
    assert SPEED in words and LIMIT in words


@pytest.mark.slow
def test_expression_is_completed_added_or_rejected_with_a_reason() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "a")
        await session.paste("deg(" + SPEED + ") - /tele")
        assert f"deg({SPEED}) - {NEAREST}" in session.text()
        await session.press("enter")
        assert plot(session).paths[-1] == f"deg({SPEED}) - {NEAREST}"
        await session.press("a")
        await session.paste("sine(/x)")
        assert "is not one of derivative" in session.text()

    run(live(), play, (120, 40))


def test_cursor_shows_values_and_moves_in_all_panes() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "c")
        before = session.app.time_cursor.stamp
        assert before is not None and "◆" in session.text()
        await session.press("left", "shift+left")
        assert session.app.time_cursor.stamp < before
        timeline = plot(session)._timeline
        assert timeline.curves[0].at(timeline.cursor) != timeline.curves[0].latest
        value = f"{timeline.curves[0].at(timeline.cursor):.3f}"
        assert value in session.text()
        await session.press("c")
        assert session.app.time_cursor.stamp is None and timeline.paused_at is None

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_presets_store_thresholds_axes_and_forms(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))

    async def play(session: Session) -> None:
        await session.press("4", "T")
        await session.paste("> 0.1")
        await session.press("enter")
        assert f"! {SPEED} > 0.1" in session.text()
        await session.press("down", "Y")
        assert "right axis" in session.text() and "├" in session.text()
        await session.press("w")
        await session.paste("drive")
        await session.press("enter", "X", "p", "enter")
        first, second = plot(session)._timeline.curves
        assert (first.path, second.path, second.right) == (SPEED, LIMIT, True)
        assert [each.text for each in first.thresholds] == ["> 0.1"]
        await session.press("f", "f")
        assert "rate" in session.text() and "20.0/s" in session.text()
        await session.press("f", "up", "v")
        assert f"against {SPEED}" in str(plot(session).border_subtitle)
        await session.press("t")
        assert "header time" in str(plot(session).border_subtitle)

    run(live(), play, (120, 40))
