"""The saved state of panes is there in the next run; unreadable state is ignored."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.settings.state_files import StateFiles


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    return tmp_path


def test_state_is_kept_per_system_and_alarms_for_all() -> None:
    one, other = StateFiles("robot"), StateFiles("/a/b.launch.py")
    assert one.put("parameters", {"filter": "speed ä"}) == "" and one.put("alarms", [{"name": "low"}]) == ""
    assert StateFiles("robot").get("parameters") == {"filter": "speed ä"} and other.get("parameters") is None
    assert other.get("alarms") == [{"name": "low"}]


def test_alarms_file_is_beside_the_settings_and_has_a_comment(folder: Path) -> None:
    StateFiles().put("alarms", [])
    assert (folder / "config" / "alarms.yaml").read_text().startswith("# Alarms of bot-console")


def test_unreadable_or_unwritable_state_is_ignored(folder: Path) -> None:
    kept = StateFiles()
    (folder / "config").mkdir()
    (folder / "config" / "alarms.yaml").write_text("a: [1\n")
    assert kept.get("alarms") is None
    (folder / "state").write_text("a file where a folder should be")
    assert kept.put("parameters", {}) and kept.get("parameters") is None
