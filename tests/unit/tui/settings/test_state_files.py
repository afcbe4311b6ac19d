"""What panes keep is there in the next run; what cannot be read is as if it had never been."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.settings.state_files import StateFiles


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    return tmp_path


def test_each_system_has_its_own_memory_and_alarms_are_everybodys() -> None:
    one, other = StateFiles("robot"), StateFiles("/a/b.launch.py")
    assert one.put("parameters", {"filter": "speed ä"}) == "" and one.put("alarms", [{"name": "low"}]) == ""
    assert StateFiles("robot").get("parameters") == {"filter": "speed ä"} and other.get("parameters") is None
    assert other.get("alarms") == [{"name": "low"}]


def test_alarms_stand_beside_the_settings_with_a_word_on_what_they_are(folder: Path) -> None:
    StateFiles().put("alarms", [])
    assert (folder / "config" / "alarms.yaml").read_text().startswith("# Alarms of bot-console")


def test_what_cannot_be_read_or_written_hinders_nobody(folder: Path) -> None:
    kept = StateFiles()
    (folder / "config").mkdir()
    (folder / "config" / "alarms.yaml").write_text("a: [1\n")
    assert kept.get("alarms") is None
    (folder / "state").write_text("a file where a folder should be")
    assert kept.put("parameters", {}) and kept.get("parameters") is None
