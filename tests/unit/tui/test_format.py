"""Texts that are cut show an ellipsis."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo
from bot_console.tui.format import parse_value
from bot_console.tui.text.sanitize import brief, cut, cut_name
from rich.cells import cell_len


def test_cut_text_ends_in_an_ellipsis() -> None:
    assert [cut("distance", width) for width in (9, 8, 7, 1, 0)] == ["distance", "distance", "distan…", "…", ""]
    assert cut("日本語", 4) == "日…" and cut("ab", 4, pad=True) == "ab  "


def test_notification_is_limited_to_a_few_lines() -> None:
    assert brief("one\ntwo") == "one\ntwo"
    many = brief("\n".join(f"parameter {each}" for each in range(399)))
    assert many.splitlines()[-1] == "... and 394 lines more" and len(many.splitlines()) == 6
    assert len(brief("x" * 10_000)) == 400


def test_a_long_name_keeps_both_ends() -> None:
    assert cut_name("/a/b", 4) == "/a/b" and cut_name("/a/b", 6, pad=True) == "/a/b  "
    assert cut_name("/robot_1/camera/image_raw", 16) == "/robo…/image_raw"
    assert all(cell_len(cut_name("/robot_1/camera/image_raw", width)) <= width for width in range(30))
    assert cell_len(cut_name("/日本語/日本語日本語", 9, pad=True)) == 9


@pytest.mark.parametrize(
    ("kind", "asked"),
    [(Kind.DOUBLE, "type a number"), (Kind.INTEGER, "type an integer"), (Kind.BOOL, "type true or false")],
)
@pytest.mark.parametrize("text", ["", "  "])
def test_empty_text_gets_a_hint_on_what_to_type(kind: Kind, asked: str, text: str) -> None:
    with pytest.raises(ValueError, match=f"^{asked}$"):
        parse_value(text, ParameterInfo("/a", "x", kind, None))
