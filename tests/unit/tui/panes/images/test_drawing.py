"""Pixels as text, and when they may be drawn."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from bot_console.tui.console.sensors.camera_image import Picture
from bot_console.tui.panes.images.drawing import characters, cost, half_blocks, pixels_of, steady
from bot_console.tui.panes.images.frame_limit import BUDGET_BYTES_PER_S, FrameLimit


def grey(rows: list[list[int]]) -> np.ndarray:
    return np.repeat(np.array(rows, np.uint8)[:, :, None], 3, axis=2)


def test_cell_shows_two_pixels_and_equal_ones_need_one_colour() -> None:
    lines = half_blocks(grey([[0, 255], [0, 0]]), 4, 3)
    assert [("".join(text for text, _ in line)) for line in lines] == ["    ", "  ▀", "    "]
    assert lines[1][1:] == ((" ", "on #000000"), ("▀", "#ffffff on #000000"))


def test_characters_go_from_black_to_white() -> None:
    assert characters(grey([[0, 128, 255], [0, 128, 255]]), 3, 1) == [(("", ""), (" +@", ""))]


def test_odd_last_row_is_padded_with_black() -> None:
    assert pixels_of(Picture(columns=1, rows=1, pixels=b"\x09\x09\x09")).shape == (2, 1, 3)


def test_noise_changes_nothing_and_costs_nothing() -> None:
    generator = np.random.default_rng(1)
    clean = grey([[60 + at for at in range(0, 160, 4)]] * 20)
    shown = steady(clean, None)
    noisy = (clean.astype(int) + generator.integers(-12, 13, clean.shape)).clip(0, 255).astype(np.uint8)
    again = steady(noisy, shown)
    assert (again == shown).all() and cost(again, shown, coloured=True) == 0
    moved = steady(np.roll(clean, 10, axis=1), shown)
    assert cost(moved, shown, coloured=True) > cost(moved, shown, coloured=False) > 0


def test_frame_rate_and_byte_budget_are_not_exceeded() -> None:
    limit, now, sent = FrameLimit(2.0), 0.0, 0
    times = []
    while now < 60.0:
        if limit.due(now):
            size = 20_000 if not times else 4000
            limit.drawn(now, size)
            sent += size
            times.append(now)
        now += 0.1
    assert sent <= BUDGET_BYTES_PER_S * 60 + 20_000 and times[1] >= 4.0
    assert all(later - earlier >= 0.5 for earlier, later in pairwise(times))
    limit.change(1000.0)
    assert limit.rate == 10.0
