"""No character that acts on a terminal comes out of what is drawn, whoever has drawn it."""

from __future__ import annotations

import unicodedata

import pytest
from bot_console.tui.terminal.cells import cells_of
from bot_console.tui.terminal.difference import ShownScreen
from hypothesis import given
from hypothesis import strategies as st
from rich.color import ColorSystem
from rich.segment import Segment
from textual.strip import Strip

HOSTILE = [
    "\x1b]0;title\x07", "\x1b]52;c;AAAA\x1b\\", "\x1b[31mred", "\x9b31m", "\x9d0;title\x9c", "\x7f", "\r\n\t\b\0",
    "\udc9b", "\u202eevil", "\u2066x\u2069", "wide 車\x1b[2J",
]  # fmt: skip
ACTING = ("Cc", "Cf", "Cs")


@pytest.mark.parametrize("plain", [False, True])
@pytest.mark.parametrize("text", HOSTILE)
def test_nothing_that_acts_on_a_terminal_is_left_of_a_text(text: str, plain: bool) -> None:
    for given_text in (text, f"before {text} behind"):
        cells = cells_of([Segment(given_text)], ColorSystem.TRUECOLOR, plain)
        assert not [each for each in "".join(cells.characters) if unicodedata.category(each) in ACTING]
        assert len(cells.characters) == len(cells.styles)


@given(st.text(max_size=30))
def test_only_escape_sequences_of_the_console_are_written(text: str) -> None:
    screen = ShownScreen()
    screen.forget(80, 1)
    written = screen.update([(0, {0: Strip([Segment(text)])})], ColorSystem.TRUECOLOR)
    body = written.replace("\x1b[1H", "").replace("\x1b[m", "").replace("\x1b[0m", "")
    assert not [each for each in body if unicodedata.category(each) in ACTING], written


@pytest.mark.parametrize("mark", "↶↷✗→▲")
def test_signs_of_the_console_do_not_cause_the_rest_of_a_line_to_be_written_again(mark: str) -> None:
    screen = ShownScreen()
    screen.forget(80, 1)
    for text in (f"{mark}0.1  indoor", f"{mark}0.2  indoor"):
        written = screen.update([(0, {0: Strip([Segment(text)])})], ColorSystem.TRUECOLOR)
    assert "2" in written and "indoor" not in written
