"""The keys of the help are laid out as in a table of Rich, but only visible lines are drawn."""

from __future__ import annotations

import asyncio

import pytest
from bot_console.tui.keys.key import Key, key_text
from bot_console.tui.screens.key_table import KEY, KeyTable, wrapped
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.console import Console
from rich.table import Table
from textual.app import App, ComposeResult
from textual.containers import VerticalScroll
from textual.strip import Strip

KEYS = [
    Key(f"key{number}", "ctrl+shift+f1" if number == 7 else "a,b", "do", " ".join(["word"] * number))
    for number in range(40)
]
HEIGHT = 12


class Help(App[None]):
    """The keys in a box that is too small for them."""

    def compose(self) -> ComposeResult:
        with VerticalScroll():
            yield KeyTable(KEYS)


@pytest.mark.parametrize("width", [50, 90])
def test_key_table_looks_like_a_rich_table(width: int) -> None:
    table = Table.grid(padding=(0, 2))
    table.add_column(justify="right", min_width=12)
    table.add_column()
    for key in KEYS:
        table.add_row(key_text(key), key.text)

    async def main() -> list[str]:
        app = Help()
        async with app.run_test(size=(width, HEIGHT)):
            keys = app.query_one(KeyTable)
            console = Console(width=keys.size.width)
            expected = ["".join(each.text for each in line).rstrip() for line in console.render_lines(table)]
            assert [keys.render_line(y).text.rstrip() for y in range(keys.size.height)] == expected
            return expected

    assert len(asyncio.run(main())) > len(KEYS), "some take several lines"


def test_only_visible_lines_are_rendered_and_carry_their_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[int] = []
    draw = KeyTable.render_line

    def noted(self: KeyTable, y: int) -> Strip:
        drawn.append(y)
        return draw(self, y)

    monkeypatch.setattr(KeyTable, "render_line", noted)

    async def main() -> None:
        app = Help()
        async with app.run_test(size=(50, HEIGHT)) as pilot:
            assert {*drawn} == {*range(HEIGHT)}
            app.query_one(VerticalScroll).scroll_end(animate=False)
            await pilot.pause()
            keys = app.query_one(KeyTable)
            assert max(drawn) == keys.size.height - 1
            pressed = [each.style and each.style.meta[KEY] for each in keys.render_line(max(drawn))]
            assert {*pressed} == {"a"}, "blanks after the text as well"

    asyncio.run(main())


@given(st.lists(st.text("ab漢", min_size=1, max_size=9), min_size=1), st.integers(1, 30))
def test_lines_are_wrapped_between_words(words: list[str], width: int) -> None:
    lines = wrapped(" ".join(words), width)
    assert " ".join(lines).split(" ") == words
    assert all(cell_len(line) <= width or " " not in line for line in lines)
