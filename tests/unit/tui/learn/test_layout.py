"""A layout that is saved beside a lesson can be loaded again, also by a console without a lesson."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.layout.tree import panes
from bot_console.tui.learn.layout import LESSON, NAME, LessonLayoutStore
from bot_console.tui.settings.layouts import FileLayouts


def test_layout_saved_beside_lesson_is_listed_without_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    tree = LESSON.tree
    assert NAME in panes(tree)
    store = FileLayouts({*panes(tree)} - {NAME})
    LessonLayoutStore(store).save("mine", tree)
    assert panes(store.layouts()["mine"].tree) == tuple(each for each in panes(tree) if each != NAME)
    assert store.problems == []
