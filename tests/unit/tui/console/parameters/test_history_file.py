"""The history: kept between runs, bounded, and consistent however the program ends."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from bot_console.tui.console.model import Change, ChangeSource, Value
from bot_console.tui.console.parameters import history_file as history_module
from bot_console.tui.console.parameters.file.patch import same
from bot_console.tui.console.parameters.history_file import ROWS_PER_TRIM, History
from bot_console.tui.console.parameters.journal import Journal
from bot_console.tui.files.folder_lock import folder_lock

SECOND = 10**9


def change(at: int, new: Value = 1.0, source: ChangeSource = ChangeSource.EDIT, **more: object) -> Change:
    return Change(at, at * SECOND, "/robot", "speed", 0.5, new, source, **more)  # type: ignore[arg-type]


def earlier_changes(file: Path, run: int = 99) -> list[Change]:
    history = History(file, run)
    found = list(history.earlier(100))
    history.close()
    return found


def test_changes_of_a_run_appear_in_the_next_one_with_negative_numbers(tmp_path: Path) -> None:
    file = tmp_path / "state" / "history.sqlite"
    first = Journal(history=History(file, 1))
    first.record(SECOND, "/robot", "speed", (0.5, 1.0), ChangeSource.PROFILE, by="indoor")
    first.record(2 * SECOND, "/robot", "speed", (1.0, 9.0), ChangeSource.EDIT, "too fast")
    assert [each.seq for each in first.after(-10)] == [0, 1], "its own changes do not count as earlier"
    first.close()
    second = Journal(history=History(file, 2))
    second.record(3 * SECOND, "/robot", "speed", (1.0, 2.0), ChangeSource.EDIT)
    assert [each.seq for each in second.after(-10)] == [-2, -1, 0]
    profile, refusal, _ = second.after(-10)
    assert (profile.source, profile.by, profile.accepted) == (ChangeSource.PROFILE, "indoor", True)
    assert (refusal.new, refusal.accepted, refusal.reason) == (9.0, False, "too fast")
    assert [each.seq for each in second.after(-1)] == [-1, 0]
    assert [each.seq for each in second.after(0)] == [0]
    assert (second.state.first, second.state.end, second.state.problem) == (0, 1, "")


def test_no_answer_still_differs_from_refusal_in_next_run(tmp_path: Path) -> None:
    file = tmp_path / "history.sqlite"
    journal = Journal(history=History(file, 1))
    journal.record(SECOND, "/robot", "speed", (0.5, 9.0), ChangeSource.EDIT, "too fast")
    journal.record(SECOND, "/robot", "speed", (0.5, 9.0), ChangeSource.EDIT, "no answer", answered=False)
    journal.record(SECOND, "/robot", "speed", (0.5, 1.0), ChangeSource.EDIT)
    expected = [(False, True), (False, False), (True, True)]
    assert [(each.accepted, each.answered) for each in journal.after(0)] == expected
    journal.close()
    assert [(each.accepted, each.answered) for each in earlier_changes(file)] == expected


VALUES: list[Value] = [
    *(None, True, 0, -(2**63), 1.0, float("nan"), float("-inf"), "größe\n'\"", ()),
    *((1, 2), (1.0, 2.5), ("a", ""), (True, False), (b"\x00", b"\xff")),
]


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_every_value_is_restored_exactly(tmp_path: Path, value: Value) -> None:
    history = History(tmp_path / "h", 1)
    history.add(change(1, value))
    history.close()
    (found,) = earlier_changes(tmp_path / "h")
    assert same(found.new, value)


def test_the_number_of_rows_is_limited(tmp_path: Path) -> None:
    history = History(tmp_path / "h", 1, rows=50)
    for number in range(ROWS_PER_TRIM + 10):
        history.add(change(number, number))
    history.close()
    found = earlier_changes(tmp_path / "h")
    assert len(found) <= 60 and found[-1].new == ROWS_PER_TRIM + 9


def test_a_change_recorded_by_two_consoles_appears_once_as_that_of_its_maker(tmp_path: Path) -> None:
    ours, theirs = History(tmp_path / "h", 1), History(tmp_path / "h", 2)
    ours.add(change(10))
    theirs.add(change(10, source=ChangeSource.OTHER))
    theirs.add(change(20, source=ChangeSource.OTHER))
    found = earlier_changes(tmp_path / "h")
    assert [(each.stamp // SECOND, each.source.value) for each in found] == [(10, "edit"), (20, "elsewhere")]
    for each in (ours, theirs):
        each.close()


def test_a_change_of_another_program_recorded_by_two_consoles_appears_once(tmp_path: Path) -> None:
    consoles = History(tmp_path / "h", 1), History(tmp_path / "h", 2)
    for second in (10, 11, 20):  # the same value twice within the time in which equal changes count as one
        for each in consoles:
            each.add(change(second, source=ChangeSource.OTHER))
    consoles[1].add(change(30, source=ChangeSource.OTHER))
    assert [each.stamp // SECOND for each in earlier_changes(tmp_path / "h")] == [10, 11, 20, 30]
    for each in consoles:
        each.close()


def test_a_file_that_is_not_a_database_is_moved_aside_and_reported(tmp_path: Path) -> None:
    file = tmp_path / "history.sqlite"
    file.write_bytes(b"not a database at all, and longer than a header of SQLite is. " * 40)
    history = History(file, 7)
    assert "starts afresh" in history.problem
    (aside,) = tmp_path.glob("*.broken-7")
    assert aside.read_bytes().startswith(b"not a database")
    history.add(change(1))
    history.close()
    assert len(earlier_changes(file)) == 1


BAD_ROWS = {
    "bytes that are not UTF-8": ("UPDATE changes SET reason = CAST(x'ff41' AS TEXT) WHERE number = 2", False),
    "a blob": ("UPDATE changes SET node = x'ff' WHERE number = 2", True),
    "a value that is no JSON": ("UPDATE changes SET new = '{' WHERE number = 2", True),
    "a value of thousands of digits": ("UPDATE changes SET new = printf('%.*c', 5000, '9') WHERE number = 2", True),
    "a value nested too deeply": ("UPDATE changes SET new = printf('%.*c', 200000, '[') WHERE number = 2", True),
    "a mapping": ("UPDATE changes SET new = '{\"a\": 1}' WHERE number = 2", True),
    "a list of mappings": ('UPDATE changes SET old = \'[{"byte": "a"}, {}]\' WHERE number = 2', True),
    "a time that is a word": ("UPDATE changes SET stamp = 'noon' WHERE number = 2", True),
    "a lone surrogate": ("UPDATE changes SET new = '\"\\ud800\"' WHERE number = 2", False),
}


@pytest.mark.parametrize(("statement", "left_out"), BAD_ROWS.values(), ids=BAD_ROWS)
def test_an_unreadable_row_does_not_affect_others(tmp_path: Path, statement: str, left_out: bool) -> None:
    file = tmp_path / "h"
    first = History(file, 1)
    for number in (1, 2, 3):
        first.add(change(number, float(number)))
    first.close()
    with sqlite3.connect(file) as link:
        link.execute(statement)
    link.close()
    journal = Journal(history=History(file, 2))
    numbers = [each.stamp // SECOND for each in journal.after(-10)]
    assert numbers == ([1, 3] if left_out else [1, 2, 3])
    assert [each.seq for each in journal.after(-10)] == list(range(-len(numbers), 0))
    assert journal.state.problem == (f"1 row of the history cannot be read and is left out: {file}" if left_out else "")
    for each in journal.after(-10):
        assert str(each).encode()
    journal.close()


@pytest.mark.parametrize(
    "bad", [change(1, reason="\udcff"), change(1, "\ud800"), change(2**70)], ids=["reason", "value", "time"]
)
def test_a_change_that_cannot_be_stored_does_not_affect_later_ones(tmp_path: Path, bad: Change) -> None:
    history = History(tmp_path / "h", 1)
    history.add(bad)
    history.add(change(2))
    assert history.problem == ""
    history.close()
    assert earlier_changes(tmp_path / "h")[-1].stamp == 2 * SECOND


def test_the_readable_part_of_a_damaged_file_is_used(tmp_path: Path) -> None:
    file = tmp_path / "h"
    first = History(file, 1)
    for number in range(400):
        first.add(change(number, reason="x" * 200))
    first.close()
    data = bytearray(file.read_bytes())
    middle = len(data) // 2 // 4096 * 4096
    data[middle : middle + 4096] = b"\xff" * 4096
    file.write_bytes(data)
    journal = Journal(history=History(file, 2))
    assert len(journal.after(-1000)) > 20 and journal.after(-1000)[-1].stamp == 399 * SECOND
    assert "cannot be read" in journal.state.problem
    journal.close()


def test_a_path_that_is_not_a_regular_file_is_not_opened(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    for name in ("pipe", "folder"):
        history = History(tmp_path / name, 1)
        history.add(change(1))
        assert history.problem == f"changes are not kept: {tmp_path / name} is not a regular file"


def test_only_one_of_two_consoles_moves_a_broken_file_aside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "h"
    file.write_bytes(b"not a database" * 1000)
    others: list[History] = []

    @contextmanager
    def other_first(folder: Path, timeout_s: float) -> Iterator[bool]:
        """Let the other console finish before this one gets the lock."""
        monkeypatch.setattr(history_module, "folder_lock", folder_lock)
        others.append(History(file, 1))
        others[0].add(change(1))
        with folder_lock(folder, timeout_s) as locked:
            yield locked

    monkeypatch.setattr(history_module, "folder_lock", other_first)
    late = History(file, 2)
    late.add(change(2))
    assert [each.name for each in tmp_path.glob("*.broken-*")] == ["h.broken-1"]
    assert (late.problem, "starts afresh" in others[0].problem) == ("", False)
    for each in (*others, late):
        each.close()
    assert [each.stamp // SECOND for each in earlier_changes(file)] == [1, 2]


def test_a_broken_file_is_left_to_the_console_that_is_repairing_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(history_module, "TIMEOUT_S", 0.0)
    (tmp_path / "h").write_bytes(b"not a database" * 1000)
    with folder_lock(tmp_path, 0.0) as locked:
        assert locked
        assert "another console is repairing" in History(tmp_path / "h", 1).problem
    assert (tmp_path / "h").read_bytes().startswith(b"not a database")


def test_a_failing_history_ends_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = Journal(history=History(tmp_path / "h", 1))

    def broken(*given: object) -> None:
        raise RuntimeError("whatever it is")

    monkeypatch.setattr(History, "add", broken)
    journal.record(1, "/n", "p", (1, 2), ChangeSource.EDIT)
    journal.record(2, "/n", "p", (2, 3), ChangeSource.EDIT)
    assert len(journal.after(0)) == 2 and "whatever it is" in journal.state.problem
    monkeypatch.setattr(History, "earlier", broken)
    assert "whatever it is" in Journal(history=History(tmp_path / "h", 2)).state.problem


def test_a_folder_that_cannot_be_created_only_disables_the_history(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    journal = Journal(history=History(tmp_path / "file" / "history.sqlite", 1))
    journal.record(1, "/n", "p", (1, 2), ChangeSource.EDIT)
    assert "not kept" in journal.state.problem and len(journal.after(0)) == 1
    journal.close()


WRITER = """
import sys
from pathlib import Path
from bot_console.tui.console.model import ChangeSource
from bot_console.tui.console.parameters.history_file import History
from bot_console.tui.console.parameters.journal import Journal
from bot_console.tui.files.save_file import save_file

folder, run = Path(sys.argv[1]), int(sys.argv[2])
journal = Journal(history=History(folder / "history.sqlite", run))
number = 0
while True:
    journal.record(number, "/robot", f"p{run}", (number, number + 1), ChangeSource.EDIT)
    save_file(folder / "saved.yaml", f"# {run}\\n" + f"value: {number}\\n" * 200)
    print(number, flush=True)
    number += 1
"""


@pytest.mark.parametrize(
    "programs", [1, pytest.param(3, marks=pytest.mark.slow), pytest.param(10, marks=pytest.mark.soak)]
)
def test_no_confirmed_change_is_lost_when_the_program_is_killed(tmp_path: Path, programs: int) -> None:
    """100 changes and saves in each of several programs, each killed in the middle of the next one."""
    confirmed: dict[str, int] = {}
    for run in range(1, programs + 1):
        command = [sys.executable, "-c", WRITER, str(tmp_path), str(run)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
            assert program.stdout is not None
            for line in program.stdout:
                confirmed[f"p{run}"] = int(line)
                if int(line) >= 99:
                    break
            program.kill()
            # Whatever it still printed before it was killed is confirmed as well.
            for line in program.stdout:
                if line.endswith("\n"):
                    confirmed[f"p{run}"] = int(line)
        lines = (tmp_path / "saved.yaml").read_text().splitlines()
        assert len(lines) == 201 and len(set(lines[1:])) == 1, "a broken file"
    with sqlite3.connect(tmp_path / "history.sqlite") as link:
        assert link.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    history = History(tmp_path / "history.sqlite", 99)
    there: dict[str, list[int]] = {}
    for each in history.earlier(100_000):
        there.setdefault(each.name, []).append(int(each.new))  # type: ignore[arg-type]
    history.close()
    assert sum(confirmed.values()) >= 99 * programs
    for name, last in confirmed.items():
        assert there[name][: last + 1] == list(range(1, last + 2))
