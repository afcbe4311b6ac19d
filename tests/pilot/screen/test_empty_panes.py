"""What a pane shows while it is empty."""

from __future__ import annotations

import pytest
from bot_console.tui.pane_table import PANES
from piloting import Session, run
from samples import empty

FRAMED = ("steering", "topics")
"""Panes with controls or headings that are there even if nothing is listed."""


@pytest.mark.parametrize("digits", ["27", pytest.param("134568HMBI", marks=pytest.mark.slow)])
def test_an_empty_pane_shows_only_its_centred_explanation(digits: str) -> None:
    async def play(session: Session) -> None:
        for entry in (each for each in PANES if each.key in digits):
            if entry.id in FRAMED:
                continue
            await session.press(entry.key)
            await session.settle()
            inside = [line[1:-1].strip() for line in session.lines()[2:-3]]
            used = [at for at, line in enumerate(inside) if line]
            block = inside[used[0] : used[-1] + 1]
            assert block.count("") == 1 and not any("─" in line for line in block), (entry.id, block)
            assert block[-1].endswith(("Help", "Topics to choose from")), (entry.id, block)
            above, below = used[0], len(inside) - 1 - used[-1]
            assert abs(above - below) <= 1, (entry.id, inside)

    run(empty(), play, (80, 24))
