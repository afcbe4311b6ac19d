"""`bot-console config` from a shell."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from processes.command_line import run_cli


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    for name in ("VISUAL", "EDITOR"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path / "config"


def config(*words: str) -> subprocess.CompletedProcess[str]:
    return run_cli("config", *words)


def test_settings_are_shown_created_edited_and_checked(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shown = config()
    assert shown.returncode == 0 and "not there yet" in shown.stdout and "theme: dark" in shown.stdout
    assert not home.exists(), "showing the settings writes nothing"
    assert config("--path").stdout.strip() == str(home / "settings.yaml")
    none = config("--edit")
    assert none.returncode == 1 and "EDITOR" in none.stderr and (home / "settings.yaml").exists()
    monkeypatch.setenv("EDITOR", f"{sys.executable} -c \"import sys; open(sys.argv[1], 'a').write('colour: red')\"")
    edited = config("--edit")
    assert edited.returncode == 1 and "'colour' is not a setting" in edited.stderr
    assert config("--check").returncode == 1
    (home / "settings.yaml").write_text("keys: {app.zoom: f9}")
    assert config("--check").returncode == 0
    assert "app.zoom" in config("--keys").stdout and " f9 " in config("--keys").stdout
    monkeypatch.setenv("EDITOR", "no-such-editor")
    assert "no-such-editor" in config("--edit").stderr
