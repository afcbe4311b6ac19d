"""A hint is printed once per terminal session, and every time if stderr is not a terminal."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.tui.cli.foreground import once_per_shell
from bot_console.tui.cli.foreground.once_per_shell import FOLDER, report_once


@pytest.fixture(autouse=True)
def marks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the markers, in a terminal."""
    base = tmp_path / "sockets"
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", str(base))
    monkeypatch.setattr(once_per_shell, "stderr_is_terminal", lambda: True)
    return base / FOLDER


def message(capsys: pytest.CaptureFixture[str], text: str) -> str:
    report_once(text)
    return capsys.readouterr().err


def test_same_text_is_printed_once(capsys: pytest.CaptureFixture[str]) -> None:
    assert [message(capsys, each) for each in ("one", "one", "two", "one")] == ["one\n", "", "two\n", ""]


def test_new_session_with_a_reused_id_gets_the_hint(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert message(capsys, "one")
    monkeypatch.setattr(once_per_shell, "_start", lambda pid: "1")
    assert message(capsys, "one") == "one\n"


def test_without_terminal_hint_is_printed_each_time_and_leaves_no_marker(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, marks: Path
) -> None:
    monkeypatch.setattr(once_per_shell, "stderr_is_terminal", lambda: False)
    assert [message(capsys, "one") for _ in range(2)] == ["one\n"] * 2
    assert not marks.exists()


def test_markers_of_ended_shells_are_removed(capsys: pytest.CaptureFixture[str], marks: Path) -> None:
    message(capsys, "one")
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    (marks / f"{ended.pid}.5.abc").touch()
    message(capsys, "two")
    assert {each.name.partition(".")[0] for each in marks.iterdir()} == {str(os.getsid(0))}


def test_hint_is_printed_if_no_marker_can_be_saved(capsys: pytest.CaptureFixture[str], marks: Path) -> None:
    marks.parent.mkdir(mode=0o755)
    marks.parent.chmod(0o755)  # Accessible to others: refused.
    assert [message(capsys, "one") for _ in range(2)] == ["one\n"] * 2
