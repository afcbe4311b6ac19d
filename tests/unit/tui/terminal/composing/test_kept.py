"""Texts that were cut are not kept for hours."""

from __future__ import annotations

from bot_console.tui.terminal.composing.kept import CUTS, keep_few_cuts
from rich.segment import Segment
from rich.style import Style


def test_few_cut_texts_are_kept_and_they_are_cut_as_before() -> None:
    before = Segment("日本語").split_cells(3)
    keep_few_cuts()
    cut = Segment._split_cells
    cut.cache_clear()
    for number in range(2 * CUTS):
        Segment(f"🤖{number}").split_cells(2)
    assert cut.cache_info().currsize == CUTS
    assert Segment("日本語").split_cells(3) == before == (Segment("日 "), Segment(" 語"))
    bold = Style(bold=True)
    assert Segment("⠿⠿⠿", bold).split_cells(1) == (Segment("⠿", bold), Segment("⠿⠿", bold))


def test_cuts_that_are_kept_stay_when_another_app_begins() -> None:
    keep_few_cuts()
    Segment("🤖").split_cells(1)
    cut = vars(Segment)["_split_cells"]
    keep_few_cuts()
    assert vars(Segment)["_split_cells"] is cut
