"""Exports the history as CSV, as YAML, or as a script that repeats the changes."""

from __future__ import annotations

import csv
import io
import shlex
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from bot_console.tui.console.model import Change, Value
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.panes.history.rows import param_set_line, source_text
from bot_console.tui.text.refusals import verdict_of_change
from bot_console.tui.text.value_text import value_text
from bot_console.tui.text.yaml_flow import quoted

COLUMNS = ("time", "node", "parameter", "old", "new", "who", "accepted", "reason")


def export(path: Path, changes: Sequence[Change]) -> int:
    """Write changes, oldest first, in the format of the file name's suffix; returns how many were written.

    Raises `NotSaved`, also for an unknown suffix.
    """
    form = FORMS.get(path.suffix.lower())
    if form is None:
        raise NotSaved(f"{path}: end the name in {', '.join(FORMS)}")
    save_file(path, form(changes))
    return len(changes)


def moment(stamp: int) -> str:
    """A time (ns since the epoch) in ISO 8601, UTC, to the microsecond."""
    return time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(stamp // 10**9)) + f".{stamp // 1000 % 10**6:06d}Z"


def as_csv(changes: Sequence[Change]) -> str:
    """A table with a header (RFC 4180)."""
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerow(COLUMNS)
    for each in changes:
        row = (moment(each.stamp), each.node, each.name, _text(each.old), _text(each.new), source_text(each))
        writer.writerow((*row, "true" if each.accepted else "false", each.reason))
    return file.getvalue()


def as_yaml(changes: Sequence[Change]) -> str:
    """A list of mappings."""
    lines = ["# Parameter changes, oldest first; times are UTC."]
    for each in changes:
        facts = {
            "time": quoted(moment(each.stamp)),
            "node": quoted(each.node),
            "parameter": quoted(each.name),
            "old": _yaml(each.old),
            "new": _yaml(each.new),
            "who": quoted(source_text(each)),
            "accepted": "true" if each.accepted else "false",
        }
        if each.reason:
            facts["reason"] = quoted(each.reason)
        text = [f"{key}: {value}" for key, value in facts.items()]
        lines += [f"- {text[0]}", *(f"  {line}" for line in text[1:])]
    return "\n".join(lines if changes else [*lines, "[]"]) + "\n"


def as_script(changes: Sequence[Change]) -> str:
    """`ros2 param set` lines that repeat the accepted changes; refused changes are comments."""
    lines = ["#!/bin/sh", "# Parameter changes, oldest first, as they were made."]
    for each in changes:
        lines.append(f"# {moment(each.stamp)} {_one_line(source_text(each))}")
        line = param_set_line(each, each.new)
        lines.append(
            line if each.accepted else f"# {verdict_of_change(each)}: {_one_line(each.reason)}: {_one_line(line)}"
        )
    return "\n".join(lines) + "\n"


FORMS: dict[str, Callable[[Sequence[Change]], str]] = {
    ".csv": as_csv,
    ".yaml": as_yaml,
    ".yml": as_yaml,
    ".sh": as_script,
}


def _one_line(text: str) -> str:
    """The text on one line, so that it cannot break out of a comment."""
    return " ".join(text.split()) if text.isprintable() else shlex.quote(" ".join(text.split()))


def _text(value: Value) -> str:
    return "" if value is None else value_text(value, exact=True)


def _yaml(value: Value) -> str:
    if value is None:
        return "null"
    if isinstance(value, tuple) and any(isinstance(each, bytes) for each in value):
        return "[" + ", ".join(f"0x{each.hex()}" for each in value if isinstance(each, bytes)) + "]"
    return quoted(value) if isinstance(value, str) else value_text(value, exact=True)
