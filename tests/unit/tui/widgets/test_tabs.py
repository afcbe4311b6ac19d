"""The line of tabs: full titles if there is room, otherwise their first characters."""

from __future__ import annotations

import re

import pytest
from bot_console.tui.pane_table import PANES
from bot_console.tui.widgets.tabs import Tab, tab_texts

IDS = ["overview", *(each.id for each in PANES)]


def line(columns: int, shown: str) -> str:
    tabs = [Tab("0", "Overview", "All", "overview", shown == "overview")]
    tabs += [Tab(each.key, each.title, each.short or each.title, each.id, each.id == shown) for each in PANES]
    return "".join(part.plain for part in tab_texts(tabs, columns, "red"))


@pytest.mark.parametrize("shown", IDS)
@pytest.mark.parametrize("columns", [80, 100, 120, 200])
def test_every_tab_has_a_name_from_80_columns_on(columns: int, shown: str) -> None:
    text = line(columns, shown)
    assert len(text) <= columns
    names = re.findall(r"[A-Za-z]{3,}", text)
    titles = ["All" if columns < 200 else "Overview", *(each.title for each in PANES)]
    assert len(names) == len(titles)
    for name, title in zip(names, titles, strict=True):
        assert title.startswith(name) or name == "Img"


@pytest.mark.parametrize("shown", IDS)
def test_the_shown_tab_is_the_one_in_brackets_and_keeps_its_name_longest(shown: str) -> None:
    title = next((each.title for each in PANES if each.id == shown), "All")
    for columns in (60, 80, 100, 120):
        (marked,) = re.findall(r"\[([^\]]*)\]", line(columns, shown))
        assert marked.split()[-1][:2] == ("Im" if title == "Images" else title[:2])


def test_nothing_is_shown_where_not_even_the_keys_have_room() -> None:
    assert line(10, "graph") == ""
