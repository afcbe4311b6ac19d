"""The natural order of names."""

from __future__ import annotations

import pytest
from bot_console.tui.text.natural import natural_key


@pytest.mark.parametrize(
    "names",
    [
        ["/robot1", "/robot2", "/robot10", "/robot10/scan", "/robots"],
        ["/robot1/a", "/robot1/b", "/robot10/a", "/robot10/b"],
        ["a", "a0", "a00", "a01", "a1", "a1b2", "a1b10", "a2", "aa", "b"],
        ["", "1", "2", "a"],
        ["x2", "x1" + "0" * 5000, "x" + "9" * 5001],
    ],
)
def test_numbers_count_by_their_value(names: list[str]) -> None:
    assert sorted(reversed(names), key=natural_key) == names
