"""Announcements of edits that make the robot less safe: they name a key only if it takes back that very edit."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from bot_console.tui.console.model import ChangeSource
from bot_console.tui.safety.safety_announcements import MAX_WAITING_CALLS, SafetyAnnouncements
from fakes.console import FakeConsole
from samples import live

NODE = "/robot_navigator"


@pytest.fixture
def console() -> FakeConsole:
    return live()[0]


@pytest.fixture
def news(console: FakeConsole) -> SafetyAnnouncements:
    made = SafetyAnnouncements(console.parameters)
    assert announcements(made, console) == []
    return made


def announcements(news: SafetyAnnouncements, console: FakeConsole, calls: int = 1) -> Sequence[str]:
    return [text for _ in range(calls) for text in news.announcements(console.snapshot())]


def test_edit_is_announced_with_the_key_that_undoes_it(news: SafetyAnnouncements, console: FakeConsole) -> None:
    console.set_parameters(NODE, {"safety_distance": 0.4})
    (text,) = announcements(news, console)
    assert text.endswith("lowers a safety margin. u in the Parameters pane undoes it.")


def test_value_that_a_refused_set_has_reverted_is_not_announced(
    news: SafetyAnnouncements, console: FakeConsole
) -> None:
    console.set_parameters(NODE, {"max_speed": 0.9})  # Undo would take this back.
    console.take(NODE, {"safety_distance": 0.4}, ChangeSource.EDIT, atomically=True)
    assert announcements(news, console) == []
    console.take(NODE, {"safety_distance": 0.8}, ChangeSource.ROLLBACK, atomically=True)
    assert announcements(news, console, MAX_WAITING_CALLS + 1) == []


def test_value_that_cannot_be_undone_is_announced_with_the_history(
    news: SafetyAnnouncements, console: FakeConsole
) -> None:
    console.set_parameters(NODE, {"max_speed": 0.9})
    console.take(NODE, {"safety_distance": 0.4}, ChangeSource.EDIT, atomically=True)
    assert announcements(news, console, MAX_WAITING_CALLS) == []
    (text,) = announcements(news, console)
    assert text.endswith("lowers a safety margin. b in the History pane undoes it.")
