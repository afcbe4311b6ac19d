"""Saved logs: parsing their lines, and following files that grow and are rotated."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.console.logs.file import CHUNK_BYTES, Tail, open_log
from bot_console.tui.console.logs.saved import SavedLines
from bot_console.tui.console.model import LogFilter, Severity

SECOND = 10**9


def records(*pieces: str) -> list[tuple[int, int, str, str]]:
    found: list[tuple[int, int, str, str]] = []
    lines = SavedLines(lambda *record: found.append(record), "run")
    for each in pieces:
        lines.feed(each)
    lines.settle()
    return found


def test_lines_of_nodes_and_launch_are_parsed_and_others_continue_a_record() -> None:
    assert records(
        "before\n[INFO] [12.5] [/arm]: one\n  File x\r\n\x1b[33m[WARNING] [1700000000.123456789] [a.b]: two\x1b[0m\n",
        "1700000001.25 [ERROR] [launch]: three\n[INFO] no head\n",
    ) == [
        (0, Severity.INFO, "run", "before"),
        (12 * SECOND + SECOND // 2, Severity.INFO, "/arm", "one\n  File x"),
        (1_700_000_000_123_456_789, Severity.WARN, "a.b", "two"),
        (1_700_000_001_250_000_000, Severity.ERROR, "launch", "three\n[INFO] no head"),
    ]


def test_a_time_beyond_the_limit_becomes_the_latest_possible_one() -> None:
    assert records("[INFO] [9999999999.9] [n]: x")[0][0] == 2**63 - 1


def new_text(tail: Tail) -> str:
    return "".join(tail.more())


def test_a_file_is_followed_through_rotation_and_truncation(tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.write_text("a\nb")
    tail = Tail(path)
    assert new_text(tail) == "a\n"
    with path.open("a") as file:
        file.write("b\nc\n")
    assert new_text(tail) == "bb\nc\n" and new_text(tail) == ""
    with path.open("a") as file:
        file.write("last words")
    os.rename(path, tmp_path / "log.1")
    assert new_text(tail) == "", "an unfinished line may continue"
    path.write_text("d\n")
    assert new_text(tail) == "last words\nd\n"
    path.write_text("")
    with path.open("a") as file:
        file.write("e\n")
    assert new_text(tail) == ""  # as long as before, so the replacement cannot be noticed yet
    path.write_text("")
    assert new_text(tail) == ""
    with path.open("a") as file:
        file.write("f\n")
    assert new_text(tail) == "f\n"
    tail.close()


def test_lines_written_just_before_a_rotation_are_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "log"
    path.write_text("a\n")
    tail = Tail(path)
    poll = os.stat

    def rotated(*which: Any, **how: Any) -> os.stat_result:
        monkeypatch.setattr(os, "stat", poll)
        with path.open("a") as file:  # after everything had been read
            file.write("b\n")
        os.rename(path, tmp_path / "log.1")
        path.write_text("c\n")
        return poll(*which, **how)

    monkeypatch.setattr(os, "stat", rotated)
    assert new_text(tail) == "a\nb\nc\n"
    tail.close()


def test_a_large_file_is_read_in_pieces_of_whole_lines(tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.write_text("x" * 999 + "\n" + ("y" * 999 + "\n") * (2 * CHUNK_BYTES // 1000))
    pieces = list(Tail(path).more())
    assert len(pieces) > 2 and all(each.endswith("\n") for each in pieces) and "".join(pieces) == path.read_text()


def test_a_saved_log_is_filtered_like_the_live_log(tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.write_text("".join(f"[INFO] [{number}.0] [n]: line {number}\n" for number in range(10)))
    log = open_log(str(path))
    try:
        view = log.view(LogFilter(words="line !7"))
        while len(view.poll().numbers) < 9:
            pass
        assert log.record(7).stamp == 7 * SECOND and log.state.end == 10  # type: ignore[union-attr]
    finally:
        log.close()


@pytest.mark.parametrize(
    ("name", "why"),
    [("", "is a folder"), ("none", "no such file"), ("pipe", "not a regular file"), ("\0", "zero byte")],
)
def test_an_unreadable_path_is_refused_with_the_reason(tmp_path: Path, name: str, why: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(ValueError, match=why):
        open_log(f"{tmp_path}/{name}")
