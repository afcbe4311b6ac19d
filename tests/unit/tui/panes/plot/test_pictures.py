"""Sparklines, one curve against another, two axes, thresholds, and pictures as files."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from bot_console.tui.files import plot_presets
from bot_console.tui.files.plot_presets import PlotPresetError, Preset, SavedCurve
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.pictures.sparklines import sparklines
from bot_console.tui.panes.plot.pictures.xy_plot import draw_xy, pairs
from bot_console.tui.panes.plot.save import picture
from bot_console.tui.panes.plot.thresholds import thresholds_of, thresholds_problem, thresholds_text
from bot_console.tui.panes.plot.view import Axes, Mark, framed_plot, legend
from bot_console.tui.panes.plot.window_facts import window_facts
from rich.cells import cell_len


def curve(path: str, values: list[float], rate: float = 10.0, colour: int = 0) -> Curve:
    return Curve(path, colour, np.arange(len(values)) / rate, np.array(values, float))


def text_of(lines: list[tuple[tuple[str, str], ...]]) -> list[str]:
    return ["".join(text for text, _ in line) for line in lines]


@pytest.mark.parametrize("width", [30, 60, 100])
@pytest.mark.parametrize("height", [2, 5, 40])
def test_sparklines_include_the_selected_curve(width: int, height: int) -> None:
    many = [curve(f"/topic_{at}/data", [at, at + 1.0] * 20) for at in range(30)]
    lines = text_of(sparklines(many, Axes(0.0, 4.0), width, height, 20))
    assert len(lines) == min(height, 31)
    assert any(line.startswith("▸ /topic_2") for line in lines)
    assert all(cell_len(line) <= width for line in lines)


def test_sparkline_shows_value_rate_minimum_and_maximum() -> None:
    line = text_of(sparklines([curve("/a/x", [1.0, 5.0, 3.0])], Axes(0.0, 1.0), 100, 3, 0))[1]
    assert line.split()[2:6] == ["3.000", "10.0/s", "1.000", "5.000"]


def test_xy_plot_pairs_values_of_the_same_time() -> None:
    x = Curve("/x", 0, np.array([0.0, 1.0, 2.0]), np.array([1.0, 2.0, np.nan]))
    y = Curve("/y", 1, np.array([-0.5, 0.5, 1.5, 2.5]), np.array([9.0, 10.0, 20.0, 30.0]))
    found = pairs(x, y, Axes(-1.0, 3.0))
    assert found[0].tolist() == pytest.approx([np.nan, 1.0, 2.0, np.nan], nan_ok=True)
    assert found[1].tolist() == pytest.approx([np.nan, 10.0, 20.0, np.nan], nan_ok=True)
    lines = text_of(draw_xy(x, [x, y], Axes(-1.0, 3.0, cursor=1.6), 60, 12))
    assert len(lines) == 12 and sum("◆" in line for line in lines) == 1
    assert text_of(draw_xy(x, [x, curve("/none", [])], Axes(-1.0, 3.0), 40, 8))


def test_second_axis_has_labels_on_the_right() -> None:
    small, large = curve("/a", [0.0, 1.0] * 20), curve("/b", [1000.0, 2000.0] * 20, colour=1)
    large.right = True
    lines = text_of(framed_plot([small, large], (), Axes(0.0, 4.0), 80, 12))
    labelled = next(each for each in lines if " 1.0 ┤" in each)
    assert "├ 2000" in labelled
    assert not any("├" in line for line in text_of(framed_plot([large], (), Axes(0.0, 4.0), 80, 12)))


def test_a_crossed_threshold_is_marked_where_it_begins_and_beside_the_value() -> None:
    one = curve("/a", [0.0] * 20 + [2.0] * 5 + [0.0] * 10 + [2.0])
    one.thresholds = thresholds_of("> 1.5")
    axis = text_of(framed_plot([one], [Mark(1.0)], Axes(0.0, 4.0), 89, 12))[-2]
    assert axis.count("!") == 2 and axis.index("!") - 9 == pytest.approx(40, abs=1)
    (name, _), _, (value, style), _ = legend(one, Axes(0.0, 4.0), 100, True)
    assert (name, value.strip(), style) == ("▸ ", "!2.000", "error")
    assert legend(one, Axes(0.0, 4.0, cursor=0.5), 100, True)[2][0].strip() == "0.000"


def test_thresholds_are_parsed_and_formatted() -> None:
    assert thresholds_text(thresholds_of("> 3/2,<= 0.2")) == "> 1.5, < 0.2"
    assert thresholds_of("") == ()
    assert "such as" in thresholds_problem("1.5") and "not a number" in thresholds_problem("> a b")


def test_window_facts_are_computed() -> None:
    facts = window_facts(curve("/a", [9.0, 1.0, np.inf, 3.0, 9.0]), 0.1, 0.3)
    assert facts is not None
    assert (facts.low, facts.high, facts.mean, facts.std, facts.gaps) == (1.0, 3.0, 2.0, 1.0, 1)
    assert facts.rate == pytest.approx(10.0)
    assert window_facts(curve("/a", [1.0]), 5.0, 6.0) is None


def test_svg_is_well_formed_for_any_names(tmp_path: Path) -> None:
    one = curve('/a<b>&"x"', [0.0, 1.0, np.nan, 2.0, 1.0] * 30)
    one.thresholds = thresholds_of("> 1")
    picture(tmp_path / "p.svg", [one], [Mark(1.0, True)], Axes(0.0, 10.0), lambda time: 1.7e9 + time)
    root = ElementTree.parse(tmp_path / "p.svg").getroot()
    texts = [each.text for each in root.iter("{http://www.w3.org/2000/svg}text")]
    assert '/a<b>&"x"' in texts and len([each for each in texts if each and each.count(":") == 2]) > 3
    numbers = [float(n) for each in root.iter("{http://www.w3.org/2000/svg}polyline")
               for pair in each.get("points", "").split() for n in pair.split(",")]  # fmt: skip
    assert min(numbers) >= 0 and max(numbers) <= 1000


def test_png_is_written_or_the_missing_package_named(tmp_path: Path) -> None:
    shown = [curve("/a", [0.0, 1.0] * 30)], (), Axes(0.0, 6.0), lambda time: 1.7e9 + time
    try:
        import cv2  # noqa: F401
    except ImportError:
        with pytest.raises(NotSaved, match="opencv"):
            picture(tmp_path / "p.png", *shown)
    else:
        picture(tmp_path / "p.png", *shown)
        assert (tmp_path / "p.png").read_bytes()[:4] == b"\x89PNG"


def test_presets_are_stored_and_invalid_files_rejected(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    preset = Preset((SavedCurve("deg(/a/x)", True, "> 1"), SavedCurve("/b/y")), 60.0, "0 1", "/b/y")
    plot_presets.save_preset("my curves", preset)
    assert plot_presets.preset_names() == ["my curves"] and plot_presets.read_preset("my curves") == preset
    for bad in (
        "[]",
        "{",
        '{"curves": 3, "window": 1}',
        '{"curves": [1], "window": 1}',
        '{"curves": [{"curve": 1}], "window": 1}',
    ):
        (tmp_path / "config" / "plots" / "bad.json").write_text(bad)
        with pytest.raises(PlotPresetError, match=r"bad\.json"):
            plot_presets.read_preset("bad")
    assert plot_presets.preset_name_problem("../x") and not plot_presets.preset_name_problem("a-1.b c")
