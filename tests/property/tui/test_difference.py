"""Whatever is on the screen and whatever is drawn next, the terminal shows the new content after the output."""

from __future__ import annotations

import re
from itertools import pairwise

from bot_console.tui.terminal.cells import cells_of
from bot_console.tui.terminal.difference import ShownScreen
from bot_console.tui.terminal.sgr import style_change
from emulator import Emulator, styled
from hypothesis import given
from hypothesis import strategies as st
from rich.color import ColorSystem
from rich.segment import Segment
from rich.style import Style
from textual.strip import Strip

WIDTH, HEIGHT = 14, 3
COLOURS = ColorSystem.TRUECOLOR
TEXTS = st.text(alphabet="ab ─⠿●日本e\u0301", max_size=6)
STYLES = st.sampled_from(
    [None, *map(Style.parse, ("bold red", "dim red", "red on blue", "on #102030", "reverse underline", "bold italic"))]
)
CUTS = st.sampled_from([(0, 14), (0, 5, 14), (0, 5, 9, 14), (0, 7, 14)])
PIECE = st.lists(st.builds(Segment, TEXTS, STYLES), max_size=4)
CODES = st.lists(
    st.sampled_from(["1", "2", "3", "4", "7", "9", "31", "94", "38;2;1;2;3", "38;5;9", "44", "48;2;9;8;7"]), unique=True
).map(";".join)


@st.composite
def screens(draw: st.DrawFn) -> dict[int, dict[int, Strip | None]]:
    """A few lines of a screen, parts of which were not drawn."""
    screen: dict[int, dict[int, Strip | None]] = {}
    for y in draw(st.lists(st.integers(0, HEIGHT - 1), unique=True, max_size=HEIGHT)):
        cuts = draw(CUTS)
        screen[y] = {
            begin: Strip(draw(PIECE)).adjust_cell_length(end - begin) if draw(st.booleans()) else None
            for begin, end in pairwise(cuts)
        }
    return screen


def visible_cells(cells: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """Cells without the text colour and weight of blanks, which nobody sees."""
    unseen = re.compile(r"(^|;)(1|2|3|3[0-7]|9[0-7]|38;2;\d+;\d+;\d+)(?=;|$)")
    lined = re.compile(r"(^|;)[479](;|$)")
    return [
        (text, style if text != " " or lined.search(style) else unseen.sub("", style).lstrip(";"))
        for text, style in cells
    ]


@given(st.lists(screens(), min_size=1, max_size=4))
def test_the_terminal_shows_what_was_drawn_last(frames) -> None:
    shown, terminal = ShownScreen(), Emulator(WIDTH, HEIGHT)
    shown.forget(WIDTH, HEIGHT)
    for frame in frames:
        terminal.feed(shown.update(frame.items(), COLOURS))
        for y, pieces in frame.items():
            for x, strip in pieces.items():
                if strip is not None:
                    cells = cells_of(strip, COLOURS)
                    expected = [
                        (character, ";".join(styled((), codes)))
                        for character, codes in zip(cells.characters, cells.styles, strict=True)
                    ]
                    assert visible_cells(terminal.cells[y][x : x + strip.cell_length]) == visible_cells(expected)


@given(screens())
def test_unchanged_content_causes_no_output(frame) -> None:
    shown = ShownScreen()
    shown.forget(WIDTH, HEIGHT)
    shown.update(frame.items(), COLOURS)
    again = {y: {x: strip and Strip([*strip]) for x, strip in pieces.items()} for y, pieces in frame.items()}
    assert shown.update(again.items(), COLOURS) == ""


@given(CODES, CODES)
def test_a_change_of_style_ends_in_the_new_style(before, after) -> None:
    sequence = style_change(before, after)
    assert (
        styled(styled((), before), sequence[2:-1]) == styled((), after)
        if sequence
        else styled((), before) == styled((), after)
    )
    assert len(sequence) <= len(style_change(None, after))
