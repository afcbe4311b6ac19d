"""Nothing that is drawn contains a character that acts on a terminal, whoever has drawn it."""

from __future__ import annotations

import unicodedata

import pytest
from bot_console.tui.terminal.cells import cells_of
from bot_console.tui.terminal.difference import ShownScreen
from hypothesis import given
from hypothesis import strategies as st
from rich.color import ColorSystem
from rich.console import Console
from rich.segment import Segment
from rich.text import Text
from textual.strip import Strip

HOSTILE = [
    "\x1b]0;title\x07", "\x1b]52;c;AAAA\x1b\\", "\x1b[31mred", "\x9b31m", "\x9d0;title\x9c", "\x7f", "\r\n\t\b\0",
    "\udc9b", "\u202eevil", "\u2066x\u2069", "wide 車\x1b[2J",
]  # fmt: skip
ACTING_CATEGORIES = ("Cc", "Cf", "Cs")


@pytest.mark.parametrize("plain", [False, True])
@pytest.mark.parametrize("text", HOSTILE)
def test_control_sequences_are_removed_from_texts(text: str, plain: bool) -> None:
    for given_text in (text, f"before {text} behind"):
        cells = cells_of([Segment(given_text)], ColorSystem.TRUECOLOR, plain)
        assert not [each for each in "".join(cells.characters) if unicodedata.category(each) in ACTING_CATEGORIES]
        assert len(cells.characters) == len(cells.styles)


@given(st.text(max_size=30))
def test_only_escape_sequences_of_the_console_are_written(text: str) -> None:
    screen = ShownScreen()
    screen.forget(80, 1)
    written = screen.update([(0, {0: Strip([Segment(text)])})], ColorSystem.TRUECOLOR)
    body = written.replace("\x1b[1H", "").replace("\x1b[m", "").replace("\x1b[0m", "")
    assert not [each for each in body if unicodedata.category(each) in ACTING_CATEGORIES], written


@pytest.mark.parametrize("mark", "↶↷✗→▲")
def test_symbols_of_the_console_do_not_cause_the_rest_of_a_line_to_be_written_again(mark: str) -> None:
    screen = ShownScreen()
    screen.forget(80, 1)
    for text in (f"{mark}0.1  indoor", f"{mark}0.2  indoor"):
        written = screen.update([(0, {0: Strip([Segment(text)])})], ColorSystem.TRUECOLOR)
    assert "2" in written and "indoor" not in written


def rewritten_output(*texts: Text) -> str:
    """The output for the last of several contents of a line."""
    screen = ShownScreen()
    screen.forget(80, 1)
    written = ""
    for text in texts:
        written = screen.update([(0, {0: Strip(text.render(Console()))})], ColorSystem.TRUECOLOR)
    return written


def test_change_before_a_character_of_uncertain_width_leaves_what_follows_it() -> None:
    written = rewritten_output(*(Text(f"12:00:0{second} 🛡 SAFE ×9") for second in (1, 2)))
    assert "2" in written and "SAFE" not in written


def test_change_after_a_character_of_uncertain_width_writes_all_that_follows() -> None:
    written = rewritten_output(*(Text(f"12:00:01 🛡 SAFE{mark} and what follows") for mark in "!?"))
    assert "? and what follows" in written and "12:00" not in written


def test_text_after_a_character_of_uncertain_width_is_written_again_when_it_disappears() -> None:
    assert "warning" in rewritten_output(Text("⚠ warning"), Text("- warning"))


def test_blank_takes_the_colours_of_its_neighbours() -> None:
    coloured = Text.assemble(("one", "red"), (" ", "green"), ("two", "red"))
    assert rewritten_output(Text("-------"), coloured).count("\x1b[") == 3  # to the line, red, and none

    assert rewritten_output(Text.assemble((" " * 7, "red")), Text.assemble((" " * 7, "bold green"))) == ""
    assert "\x1b[4m" in rewritten_output(Text("       "), Text.assemble((" " * 7, "underline"))).replace("0;", "")
