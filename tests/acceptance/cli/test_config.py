"""`bot-console config` from a shell."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    for name in ("VISUAL", "EDITOR"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path / "config"


def typed(*words: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "bot_console.tui", "config", *words]
    return subprocess.run(line, capture_output=True, text=True, timeout=240, check=False, env={**os.environ})


def test_settings_are_shown_created_edited_and_checked(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shown = typed()
    assert shown.returncode == 0 and "not there yet" in shown.stdout and "theme: dark" in shown.stdout
    assert not home.exists(), "showing writes nothing"
    assert typed("--path").stdout.strip() == str(home / "settings.yaml")
    none = typed("--edit")
    assert none.returncode == 1 and "EDITOR" in none.stderr and (home / "settings.yaml").exists()
    monkeypatch.setenv("EDITOR", f"{sys.executable} -c \"import sys; open(sys.argv[1], 'a').write('colour: red')\"")
    edited = typed("--edit")
    assert edited.returncode == 1 and "'colour' is not a setting" in edited.stderr
    assert typed("--check").returncode == 1
    (home / "settings.yaml").write_text("keys: {app.zoom: f9}")
    assert typed("--check").returncode == 0
    assert "app.zoom" in typed("--keys").stdout and " f9 " in typed("--keys").stdout
    monkeypatch.setenv("EDITOR", "no-such-editor")
    assert "no-such-editor" in typed("--edit").stderr
