"""Files that the program keeps between runs: each function feeds a text to one of them, as if it had been damaged."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from contextlib import closing
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

from files import FOLDER, file

ROW = ("2", "1000", "/robot", "speed", "0.5", "[1.0, 2]", "edit", "1", "too fast", "")
"""The columns of a change, one per line in the inputs; digits become integers, a leading `x` makes bytes."""
GOOD = (2, 1, "/robot", "speed", "0.5", "1.0", "edit", 1, "", "")


def stop_file(text: str) -> None:
    from bot_console_robot.safety.latch import Latch
    from bot_console_robot.safety.lock import Lock
    from bot_console_robot.safety.stop_file import StopFile
    from bot_console_robot.safety.stop_messages import State, parse_state, state_message

    path = file(text, "stops.json")
    kept = StopFile(str(path), "/").merge(Lock())
    latch = Latch()
    latch.follow(kept)
    latch.stop("node", "why")
    assert latch.lock.held and kept.ids <= latch.lock.ids
    assert parse_state(state_message(State(latch.lock, "1"), "n")).lock == latch.lock
    assert StopFile(str(path), "/").merge(latch.lock).kept.ids >= kept.ids
    latch.release([each.id for each in latch.lock.stops], "anna")
    StopFile(str(path), "/").merge(latch.lock)
    assert not StopFile(str(path), "/").merge(Lock()).held


def stop_file_seeds() -> Sequence[str]:
    from bot_console_robot.safety.lock import Lock, Stop
    from bot_console_robot.safety.stop_file import StopFile

    stops = Lock().with_stop(Stop("a1", "k", "anna", "too close")).with_stop(Stop("b2", "l", "ben", "why"))
    found: list[str] = []
    for number, lock in enumerate((stops, stops.without(["a1"], "ben"), Lock())):
        path = FOLDER / f"stops-{number}.json"
        StopFile(str(path), "/").merge(lock)
        StopFile(str(path), "/robot2").merge(lock)
        found.append(path.read_text())
    return found


@cache
def history() -> Any:
    from bot_console.tui.console.parameters.history_file import History

    return History(FOLDER / "history.sqlite", 1)


def history_row(text: str) -> None:
    """An arbitrary row between two good ones, which are still read."""
    import sqlite3

    from bot_console.tui.console.parameters.history_file import UNSTORABLE

    store = history()
    columns = [_column(each) for each in (text.split("\n") + [""] * 10)[:10]]
    with closing(sqlite3.connect(store._file)) as link, link:
        link.execute("DELETE FROM changes")
        insert = "INSERT INTO changes (run, stamp, node, name, old, new, source, accepted, reason, part_of) VALUES "
        link.execute(f"{insert} ({', '.join('?' * 10)})", GOOD)
        try:
            link.execute(f"{insert} ({', '.join(sql for sql, _ in columns)})", [value for _, value in columns])
        except (*UNSTORABLE, sqlite3.OperationalError):
            pass  # SQLite itself refuses it
        link.execute(f"{insert} ({', '.join('?' * 10)})", GOOD)
    found = store.earlier(10)
    assert [each.name for each in found].count("speed") >= 2, found
    for each in found:
        "".join((each.node, each.name, each.reason, each.by)).encode()


def _column(text: str) -> tuple[str, Any]:
    """The SQL and the value of a column: a number, bytes, or text that need not be UTF-8."""
    if re.fullmatch(r"-?[0-9]{1,18}", text):
        return "?", int(text)
    data = text.encode("utf-8", "surrogatepass")
    return ("?", data[1:]) if text.startswith("x") else ("CAST(? AS TEXT)", data)


def history_file(text: str) -> None:
    """An arbitrary file in place of the history: changes are recorded again, or the problem is reported."""
    from bot_console.tui.console.model import Change, ChangeSource
    from bot_console.tui.console.parameters.history_file import History

    path = FOLDER / "damaged" / "history.sqlite"
    path.parent.mkdir(exist_ok=True)
    for each in path.parent.iterdir():
        each.unlink()
    path.write_bytes(text.encode("latin-1", "replace"))
    with closing(History(path, 2)) as store:
        store.earlier(10)
        store.add(Change(0, 1, "/robot", "speed", 0.5, 1.0, ChangeSource.EDIT, True))
        kept = not store.problem
    with closing(History(path, 3)) as store:
        assert not kept or store.problem or store.earlier(10)


def history_file_seeds() -> Sequence[str]:
    import sqlite3

    from bot_console.tui.console.parameters.history_file import History

    path = FOLDER / "seed.sqlite"
    History(path, 1).close()
    with closing(sqlite3.connect(path)) as link:
        link.execute("PRAGMA journal_mode = DELETE")
        with link:
            link.executemany(f"INSERT INTO changes VALUES (NULL, {', '.join('?' * 10)})", [GOOD] * 3)
    return [path.read_bytes().decode("latin-1")]


def pane_states(text: str) -> None:
    """The saved states of panes."""
    from bot_console.tui.panes.alarms.alarm import alarm_texts_in
    from bot_console.tui.panes.graph.view_state import view_state_of as graph_view_of
    from bot_console.tui.panes.parameters.view_state import view_state_of as parameter_view_of
    from bot_console.tui.settings.yaml_reader import NotPlainData, read_yaml

    try:
        data = read_yaml(text.encode("utf-8", "surrogatepass"))
    except NotPlainData:
        return
    graph_view_of(data)
    parameter_view_of(data)
    alarm_texts_in(data)


def lines_of_stores(text: str) -> None:
    """The rules of the log, typed lines, commands of a lesson, and reports of a search, one per line."""
    from bot_console.tui.commanding.history import LineHistory
    from bot_console.tui.learn.command_log import read_log
    from bot_console.tui.panes.logs.rules import RuleBook
    from bot_console.tui.tuning.run_journal import TuningJournal

    path = file(text, "lines.txt")
    book = RuleBook(path)
    book.read()
    history = LineHistory(path)
    history.lines()
    history.step("a", -1)
    read_log(str(path))
    specification = SimpleNamespace(digest="lines")
    file(text, "lines.jsonl")
    TuningJournal(FOLDER, cast(Any, specification), resume=True).close()


def progress(text: str) -> None:
    from bot_console.tui.learn.progress import FOLDER as PLACE
    from bot_console.tui.learn.progress import read_progress

    (FOLDER / PLACE).mkdir(exist_ok=True)
    file(text, f"{PLACE}/course.json")
    found = read_progress(FOLDER, "course")
    found.path = FOLDER / "progress.json"
    found.save()


def preset_of_curves(text: str) -> None:
    from bot_console.tui.files import plot_presets

    folder = plot_presets._folder()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "a.json").write_bytes(text.encode("utf-8", "surrogatepass"))
    found = plot_presets.read_preset("a")
    json.dumps([found.window, found.limits, found.against])


def background(text: str) -> None:
    from bot_console.tui.cli.verbs.background import _read

    known = _read(Path(file(text, "background.json")))
    if known is not None:
        known.runs()
        known.describe().encode("utf-8", "surrogatepass")
