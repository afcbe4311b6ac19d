"""The program's own files are read without values that JSON allows but we never write."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from bot_console.tui.cli.verbs.background import Background, _read
from bot_console.tui.files import plot_presets
from bot_console.tui.files.folders import OVERRIDE
from bot_console.tui.learn.command_log import read_log
from bot_console.tui.learn.progress import FOLDER, read_progress
from bot_console.tui.panes.graph.view_state import view_state_of as graph_view_of
from bot_console.tui.panes.parameters.view_state import view_state_of as parameter_view_of
from bot_console.tui.tuning.run_journal import TuningJournal

STRANGE = ["1e999", "-1e999", "NaN", "1" + "0" * 400, "-1", "[]", "{}", "null", '"a"', "true", "[" * 100_000]


@pytest.mark.parametrize("value", STRANGE, ids=lambda each: each[:8])
def test_damaged_record_of_a_background_system_is_ignored_or_not_running(tmp_path: Path, value: str) -> None:
    file = tmp_path / "background.json"
    for pid, words in ((value, '["indoor"]'), ("1", f"[{value}]"), ("1", value)):
        file.write_text(f'{{"pid": {pid}, "words": {words}, "log": "/tmp/a.log"}}')
        found = _read(file)
        assert found is None or (not found.runs() and found.describe())


def test_impossible_process_id_does_not_count_as_running() -> None:
    assert not any(Background(pid, (), "").runs() for pid in (-1, 0, 10**20))


@pytest.mark.parametrize("value", STRANGE, ids=lambda each: each[:8])
def test_other_commands_of_a_lesson_are_still_read(tmp_path: Path, value: str) -> None:
    good = {"words": ["topic", "list"], "code": 0, "pid": 12, "at": 1.0, "errors": ""}
    line = json.dumps(good)
    strange = [line.replace(f": {json.dumps(each)}", f": {value}") for each in good.values()]
    (tmp_path / "log").write_text("\n".join([line, *strange, value, line, ""]))
    found = [each.words for each in read_log(str(tmp_path / "log"))]
    assert found[0] == found[-1] == ("topic", "list")


@pytest.mark.parametrize("value", STRANGE, ids=lambda each: each[:8])
def test_progress_that_cannot_be_read_is_reported_and_kept(tmp_path: Path, value: str) -> None:
    path = tmp_path / FOLDER / "course.json"
    path.parent.mkdir()
    path.write_text(value)
    found = read_progress(tmp_path, "course")
    assert found.problem and found.path != path


@pytest.mark.parametrize("value", STRANGE, ids=lambda each: each[:8])
def test_reports_before_an_invalid_line_are_resumed(tmp_path: Path, value: str) -> None:
    (tmp_path / "a.jsonl").write_text(f'{{"trial": "t", "report": {{}}}}\n{{"trial": {value}, "report": {value}}}\n')
    journal = TuningJournal(tmp_path, cast(Any, SimpleNamespace(digest="a")), resume=True)
    journal.close()
    assert journal.resumed == 1


@pytest.mark.parametrize("value", [each for each in STRANGE if each not in ("NaN", "-1")], ids=lambda each: each[:8])
def test_curves_with_an_invalid_window_are_read_or_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, value: str
) -> None:
    monkeypatch.setenv(OVERRIDE, str(tmp_path))
    file = tmp_path / "config" / "plots" / "a.json"
    file.parent.mkdir(parents=True)
    file.write_text(f'{{"curves": [], "window": {value}}}')
    try:
        assert plot_presets.read_preset("a").window
    except plot_presets.PlotPresetError as error:
        assert "a.json" in str(error)


@pytest.mark.parametrize("value", [10**5000, -1, None, [], {}, 1e308, True], ids=lambda each: type(each).__name__)
def test_view_with_invalid_values_gets_the_defaults(value: object) -> None:
    assert graph_view_of({"folds": [value], "mode": value, "rates": "x"}) == graph_view_of({"folds": []})
    assert parameter_view_of({"filter": value, "closed": [value], "at": [value] * 3}) == parameter_view_of({})
