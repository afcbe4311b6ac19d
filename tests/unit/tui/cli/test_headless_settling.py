"""Waiting until a value is stable: the first value that lasts, or the last one before the timeout."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from bot_console.tui.session import reached_console
from bot_console.tui.session.reached_console import POLL_S, wait_until_settled


@pytest.fixture
def slept_seconds(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The seconds slept so far; nothing else makes time advance."""
    slept: list[float] = []
    clock = SimpleNamespace(monotonic=lambda: sum(slept), sleep=slept.append)
    monkeypatch.setattr(reached_console, "time", clock)
    return slept


def test_changing_value_is_awaited_until_it_is_stable(slept_seconds):
    polls = iter([0, 1, 2, 3])
    assert wait_until_settled(lambda: next(polls, 3), bool, 0.5, 10.0) == 3
    assert sum(slept_seconds) == pytest.approx(3 * POLL_S + 0.5)


def test_missing_value_is_awaited_for_the_whole_timeout(slept_seconds):
    assert wait_until_settled(lambda: 0, bool, 0.5, 2.0) == 0
    assert sum(slept_seconds) == pytest.approx(2.0, abs=POLL_S)
