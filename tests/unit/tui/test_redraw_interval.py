"""When figures that change all the time are drawn again."""

from __future__ import annotations

from bot_console.tui.text.redraw_interval import is_due


def test_updates_begun_at_different_times_are_due_at_the_same_moment() -> None:
    for before in (100.0, 100.3, 100.9):
        assert not is_due(before, 100.95, 1.0) and is_due(before, 101.0, 1.0)
    assert not is_due(101.0, 101.9, 2.0) and is_due(101.0, 102.0, 2.0)


def test_update_that_was_never_drawn_is_due() -> None:
    assert is_due(float("-inf"), 0.0, 1.0)
