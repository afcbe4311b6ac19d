"""The curves that a line such as `plot /a - /b /c` names."""

from __future__ import annotations

import pytest
from bot_console.tui.commanding.verbs import split_curves


@pytest.mark.parametrize(
    ("line", "curves"),
    [
        ("/a/x /b/x", ["/a/x", "/b/x"]),
        ("/a/x - /b/x", ["/a/x - /b/x"]),
        ("/a/x -/b/x /c", ["/a/x -/b/x", "/c"]),
        ("/a/x / /b/x", ["/a/x / /b/x"]),
        ("/a/x // 2", ["/a/x // 2"]),
        ("mean(/a/x, 1 s)", ["mean(/a/x, 1 s)"]),
        ("mean(/a/x, 1 s) /c", ["mean(/a/x, 1 s)", "/c"]),
        ("abs( /a/x ) * 2 /node:speed", ["abs( /a/x ) * 2", "/node:speed"]),
        ("/a -", ["/a -"]),
        ("", []),
    ],
)
def test_blanks_within_an_expression_do_not_start_another_curve(line: str, curves: list[str]) -> None:
    assert split_curves(line.split()) == curves
