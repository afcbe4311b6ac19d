"""Whatever has replaced one of the console's files, reading it neither fails nor blocks, and is reported once."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from bot_console.tui.commanding.history import LineHistory
from bot_console.tui.console.parameters.history_file import History
from bot_console.tui.console.parameters.journal import Journal
from bot_console.tui.console.parameters.profile_store import ProfileStore
from bot_console.tui.files.folders import OVERRIDE, config_folder, state_folder
from bot_console.tui.files.plot_presets import PlotPresetError, read_preset
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.logs.rules import RuleBook
from bot_console.tui.settings.layouts import FileLayouts
from bot_console.tui.settings.settings import read_settings
from bot_console.tui.settings.state_files import StateFiles
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sampling import slow_after

TIMEOUT_S = 240.0
"""Seconds after which a blocking read fails its test."""


def read_layouts() -> list[str]:
    store = FileLayouts([each.id for each in PANES])
    store.layouts()
    return store.problems


def read_last_screen() -> list[str]:
    FileLayouts([each.id for each in PANES]).last()
    return []


def read_rules() -> list[str]:
    book = RuleBook()
    book.read()
    return book.problems


def read_history() -> list[str]:
    journal = Journal(history=History(state_folder() / "history.sqlite", 1))
    problem = journal.state.problem
    journal.close()
    return [problem] if problem else []


def read_profile() -> list[str]:
    return [each.problem for each in ProfileStore([config_folder() / "profiles"]).profiles if each.problem]


def read_curves() -> list[str]:
    try:
        read_preset("a")
    except PlotPresetError as error:
        return [str(error)]
    return []


def read_lines() -> list[str]:
    LineHistory().lines()
    return []


def read_alarms() -> list[str]:
    StateFiles().get("alarms")
    return []


def read_view() -> list[str]:
    StateFiles().get("plot")
    return []


STORES: dict[str, tuple[Callable[[], Path], Callable[[], list[str]], bool]] = {
    "settings": (lambda: config_folder() / "settings.yaml", lambda: [*read_settings().problems], True),
    "a layout": (lambda: config_folder() / "layouts" / "a.yaml", read_layouts, True),
    "the last screen": (lambda: state_folder() / "screen.yaml", read_last_screen, False),
    "rules for the log": (lambda: config_folder() / "log-rules.txt", read_rules, True),
    "the history": (lambda: state_folder() / "history.sqlite", read_history, True),
    "a profile": (lambda: config_folder() / "profiles" / "a.yaml", read_profile, True),
    "curves": (lambda: config_folder() / "plots" / "a.json", read_curves, True),
    "command lines": (lambda: state_folder() / "command-lines.txt", read_lines, False),
    "alarms": (lambda: config_folder() / "alarms.yaml", read_alarms, False),
    "a view": (lambda: StateFiles()._path("plot"), read_view, False),
}
"""The path of each file, a function that reads it and returns problems, and whether an unusable file is reported."""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv(OVERRIDE, str(tmp_path))
    yield tmp_path


def read_in_time(read: Callable[[], list[str]]) -> list[str]:
    found: list[list[str]] = []
    reading = threading.Thread(target=lambda: found.append(read()), daemon=True)
    reading.start()
    reading.join(TIMEOUT_S)
    assert found, "reading blocks, or has failed"
    return found[0]


@pytest.mark.skipif(os.name == "nt", reason="needs named pipes")
@pytest.mark.parametrize("kind", ["pipe", "folder", "link to itself", "link to nothing", "huge"])
@pytest.mark.parametrize(("where", "read", "reports"), STORES.values(), ids=STORES)
def test_a_path_that_is_not_a_regular_file_is_reported_once(
    where: Callable[[], Path], read: Callable[[], list[str]], reports: bool, kind: str
) -> None:
    path = where()
    path.parent.mkdir(parents=True, exist_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    elif kind == "huge":
        with path.open("wb") as file:
            file.truncate(3_000_000_000)
    else:
        path.symlink_to(path if kind == "link to itself" else path.with_name("nothing"))
    problems = read_in_time(read)
    if reports and kind in ("pipe", "folder"):
        assert len(problems) == 1 and (str(path) in problems[0] or read is read_profile)


GARBAGE = st.one_of(
    st.binary(max_size=200),
    st.sampled_from(
        [
            b"\xff\xfe\x00", b'"\\ud800"', b'{"name": "\\udcff", "layout": ["\\ud800"]}', b"theme: \xff", b"[" * 5000,
            b"a: &a [*a, *a]", b"!!python/object:os.system {}", b"{" + b'"a":' * 3000, b"1" * 6000, b"- - - -\n" * 100,
            b"keys: {1: [2]}", b"layout: {beside: [1, {}], share: [1e400, -1]}", b"theme: dark\ntheme: [", b"\0" * 100,
            b"curves: 7", b'{"curves": [{"curve": 7}], "window": "x"}', b'{"curves": {"a": 1}}', b"hide\nred (((\n",
            b"SQLite format 3\0" + b"\x10\0\1\1\0\x40\x20\x20" + b"\xff" * 4072, b"SQLite format 3\0",
        ]
    ),
)  # fmt: skip


@pytest.mark.parametrize(("where", "read", "reports"), slow_after(3, STORES.values()), ids=STORES)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(content=GARBAGE)
def test_any_content_can_be_read(
    where: Callable[[], Path], read: Callable[[], list[str]], reports: bool, content: bytes
) -> None:
    path = where()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    for each in read():
        assert each.encode() and "\n" not in each
