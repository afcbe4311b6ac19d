"""The exported history can be read by the usual readers: csv, YAML, and a shell."""

from __future__ import annotations

import csv
import shlex
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from bot_console.tui.console.model import Change, ChangeSource, Value
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.panes.history.export import export

VALUES: list[tuple[Value, Value]] = [
    *((1.0, 2.5), (True, False), (None, "a"), ("it's", "new\nline\t'\"$(touch x)`"), (-3, -4)),
    *(((1.0,), (1.0, 2.0)), ((b"\x00",), (b"\x01", b"\xff")), (("a",), ("b, c", "d"))),
]
CHANGES = [
    Change(at, 1_700_000_000_000_000_000 + at, "/n", f"p{at}", old, new, ChangeSource.PROFILE, by="indoor")
    for at, (old, new) in enumerate(VALUES)
]
REFUSED = Change(99, 1_700_000_000_000_000_000, "/n", "speed", 1.0, 9.0, ChangeSource.EDIT, False, "no\n$(touch x)")


def test_changes_are_exported_as_csv(tmp_path: Path) -> None:
    assert export(tmp_path / "h.csv", [*CHANGES, REFUSED]) == len(CHANGES) + 1
    rows = list(csv.DictReader((tmp_path / "h.csv").open(newline="")))
    assert [each["parameter"] for each in rows] == [*(each.name for each in CHANGES), "speed"]
    assert rows[0]["time"] == "2023-11-14T22:13:20.000000Z"
    assert (rows[0]["old"], rows[0]["new"], rows[0]["who"]) == ("1.0", "2.5", "profile indoor")
    assert rows[3]["new"] == VALUES[3][1]
    assert (rows[-1]["accepted"], rows[-1]["reason"]) == ("false", REFUSED.reason)


def test_script_distinguishes_no_answer_from_refusal(tmp_path: Path) -> None:
    export(tmp_path / "h.sh", [REFUSED, replace(REFUSED, answered=False, reason="no answer")])
    comments = [each for each in (tmp_path / "h.sh").read_text().splitlines() if "ros2 param set" in each]
    assert comments[0].startswith("# refused: 'no") and comments[1].startswith("# not set: no answer: ros2")


def test_changes_are_exported_as_yaml(tmp_path: Path) -> None:
    export(tmp_path / "h.yaml", [*CHANGES, REFUSED])
    rows = yaml.safe_load((tmp_path / "h.yaml").read_text())
    for (old, new), row in zip(VALUES, rows, strict=False):
        if not (isinstance(new, tuple) and isinstance(new[0], bytes)):
            assert (row["old"], row["new"]) == tuple(
                list(each) if isinstance(each, tuple) else each for each in (old, new)
            )
    assert rows[6]["new"] == [1, 255]
    assert rows[-1]["reason"] == REFUSED.reason and rows[-1]["accepted"] is False
    export(tmp_path / "none.yml", [])
    assert yaml.safe_load((tmp_path / "none.yml").read_text()) == []


def test_script_sets_only_accepted_values(tmp_path: Path) -> None:
    """A stand-in for `ros2` records the arguments with which it was called."""
    export(tmp_path / "h.sh", [*CHANGES, REFUSED])
    (tmp_path / "ros2").write_text('#!/bin/sh\nprintf "%s\\0" "$@" >> called\nprintf "\\n" >> called\n')
    (tmp_path / "ros2").chmod(0o755)
    subprocess.run(["/bin/sh", "h.sh"], cwd=tmp_path, env={"PATH": f"{tmp_path}:/usr/bin:/bin"}, check=True)
    called = [line.split("\0") for line in (tmp_path / "called").read_text().split("\0\n") if line]
    assert not (tmp_path / "x").exists()
    names = [each[3] for each in called]
    assert names == [f"p{at}" for at in (0, 1, 2, 3, 4, 5, 7)], "bytes have no command"
    assert yaml.safe_load(called[3][4]) == VALUES[3][1]
    text = (tmp_path / "h.sh").read_text()
    assert "# refused" in text and shlex.split(text.splitlines()[3])[:3] == ["ros2", "param", "set"]


def test_unknown_file_extension_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(NotSaved, match=r"end the name in .csv"):
        export(tmp_path / "h.txt", CHANGES)
