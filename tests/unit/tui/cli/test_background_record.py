"""The record of a background system is found again, whatever happens to temporary files."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.tui.cli.verbs import background
from bot_console.tui.cli.verbs.background import Background
from bot_console.tui.files.folders import OVERRIDE

SLEEPER = [sys.executable, "-c", "import signal; print('runs', flush=True); signal.pause()"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the domain; the user's folders are beside it."""
    monkeypatch.setenv(OVERRIDE, str(tmp_path / "user"))
    monkeypatch.setattr(background, "_file", lambda: tmp_path / "domain" / "background.json")
    return tmp_path / "domain"


@pytest.mark.skipif(sys.platform == "win32", reason="needs process sessions")
def test_down_ends_system_whose_domain_folder_was_deleted(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(background, "take_part", lambda: "")
    monkeypatch.setattr(background, "running_robot_nodes", list)
    with subprocess.Popen(SLEEPER, stdout=subprocess.PIPE, start_new_session=True) as process:
        assert process.stdout is not None and process.stdout.readline()
        monkeypatch.setattr(Background, "runs", lambda self: process.poll() is None)
        assert background._save(Background(process.pid, ("outdoor",), "the log")) == ""
        shutil.rmtree(folder)
        try:
            assert background.down([]) == 0
            assert process.poll() is not None
        finally:
            process.kill()
    assert capsys.readouterr().out == f"ended: process {process.pid} (outdoor), log the log\n"
    assert background.down([]) == 1


def test_system_recorded_in_one_of_two_places_is_known(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Background, "runs", lambda self: True)
    folder.write_text("in the way")
    assert background._save(Background(7, (), "the log")) == ""
    known = background._running_system()
    assert known is not None and known.pid == 7
    background._forget()
    assert background._running_system() is None


def test_failure_to_record_a_system_names_the_file(folder: Path) -> None:
    for each in (folder, folder.with_name("user")):
        each.write_text("in the way")
    assert str(folder) in background._save(Background(7, (), "the log"))
