"""The log of a background system: lines in rotating files; only the logs of the newest systems are kept."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.runtime.process import on_notice
from bot_console.tui.session import system_log
from bot_console.tui.session.system_log import MAX_OLD_FILES, MAX_SYSTEMS, SystemLog, new_log


def test_log_lines_and_prints_go_to_rotating_files(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    log = SystemLog(path, max_bytes=200)
    log.logged(1_700_000_000_123_456_789, 30, "talker", "100 % \udcff", ("", "", 0))
    log.printed(20, "talker-1", "up")
    log.close()
    first, second = path.read_text(encoding="utf-8").splitlines()
    assert first == "[WARN] [1700000000.123457] [talker]: 100 % \\udcff"
    assert second.startswith("[INFO] [") and second.endswith("] [talker-1]: up")
    log = SystemLog(path, max_bytes=200)
    for number in range(100):
        log.printed(20, "n", f"line {number}")
    log.close()
    files = sorted(each.name for each in tmp_path.iterdir())
    assert files == ["a.log", *(f"a.log.{part}" for part in range(1, MAX_OLD_FILES + 1))]
    assert all(each.stat().st_size <= 200 for each in tmp_path.iterdir())
    assert "line 99" in path.read_text(encoding="utf-8")


def test_logs_of_old_systems_are_deleted_with_all_parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system_log, "state_folder", lambda: tmp_path)
    folder = new_log(1).parent
    for number in range(MAX_SYSTEMS + 2):
        for name in (f"{number}.log", f"{number}.log.1"):
            (folder / name).write_text("x")
            os.utime(folder / name, (number, number))
    new_log(2)
    kept = {each.name for each in folder.iterdir()}
    assert kept == {f"{number}.log{part}" for number in range(3, MAX_SYSTEMS + 2) for part in ("", ".1")}


def test_unwritable_log_is_reported_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log, reported = SystemLog(tmp_path / "a.log"), list[str]()
    (tmp_path / "a.log").mkdir()

    def notice(process: object, text: str) -> None:
        reported.append(text)
        log.printed(30, "bot-console", text)

    forget = on_notice(notice)
    for number in range(3):
        log.printed(20, "talker", f"line {number}")
    forget()
    assert reported == [f"log files are not complete: {tmp_path} cannot be written (Is a directory)"]
    assert capsys.readouterr().err == ""
