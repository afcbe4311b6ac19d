"""The cache of cut texts stays bounded."""

from __future__ import annotations

from bot_console.tui.terminal.cache_limits import MAX_CUTS, limit_cut_cache
from rich.segment import Segment
from rich.style import Style


def test_only_a_few_cut_texts_are_cached_and_cuts_stay_the_same() -> None:
    before = Segment("日本語").split_cells(3)
    limit_cut_cache()
    cut = Segment._split_cells
    cut.cache_clear()
    for number in range(2 * MAX_CUTS):
        Segment(f"🤖{number}").split_cells(2)
    assert cut.cache_info().currsize == MAX_CUTS
    assert Segment("日本語").split_cells(3) == before == (Segment("日 "), Segment(" 語"))
    bold = Style(bold=True)
    assert Segment("⠿⠿⠿", bold).split_cells(1) == (Segment("⠿", bold), Segment("⠿⠿", bold))


def test_cached_cuts_survive_the_start_of_another_app() -> None:
    limit_cut_cache()
    Segment("🤖").split_cells(1)
    cut = vars(Segment)["_split_cells"]
    limit_cut_cache()
    assert vars(Segment)["_split_cells"] is cut
