"""Caches of widget queries by the screen and the panes stay bounded for hours."""

from __future__ import annotations

import pytest
from bot_console.tui.terminal import cache_limits
from piloting import Session, run
from samples import live

FEW = 3


def test_caches_stay_small_when_panes_are_switched_often(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache_limits, "MAX_ANSWERS", FEW)

    async def play(session: Session) -> None:
        await session.press(*"123412")
        maximum = {type(each).__name__: len(each._query_one_cache) for each in session.app.screen.walk_children()}
        maximum["the screen"] = len(session.app.screen._query_one_cache)
        assert max(maximum.values()) == FEW, maximum

    run(live(), play)
