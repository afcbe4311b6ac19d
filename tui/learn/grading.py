"""Grades a workspace by the rows of a course, each in a fresh copy of the workspace and a separate domain."""

from __future__ import annotations

import json
import shlex
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast
from xml.etree import ElementTree

from bot_console.tui.cli.check.stepped import NOT_REACHED
from bot_console.tui.learn.activity import Activity
from bot_console.tui.learn.condition_check import NO_PACKAGE, missing, with_names
from bot_console.tui.learn.course import Course
from bot_console.tui.learn.files import WorkspaceFiles
from bot_console.tui.learn.grade_row import Drive, GradeRow
from bot_console.tui.learn.sandbox import RunResult, Sandbox, make_sandbox

ROW_TIMEOUT_S = 90.0
"""Seconds that a row may take."""
NODES_TIMEOUT_S = 15
"""Simulated seconds within which the nodes of a row have to appear."""
SEED = 1
CHECK = '$BOT_CONSOLE check "$HOME/script" --json --wait {wait} --seed {seed} {starts} > "$HOME/report"'
DRIVE = '$BOT_CONSOLE --headless --fast --seed {seed} --duration {seconds} --launch {words} > "$HOME/report"'
EXPLAINING_LINES = 3
"""Number of the last lines of a program's output that are quoted to explain a failure."""


@dataclass(frozen=True)
class RowResult:
    """A row, and why it failed; `why` is empty if it passed."""

    row: GradeRow
    why: str

    @property
    def points(self) -> float:
        """The points achieved."""
        return 0.0 if self.why else self.row.points

    @property
    def failed(self) -> bool:
        """Whether the workspace does not pass because of this row."""
        return bool(self.why) and not self.row.extra


def grade(course: Course, workspace: Path, *, allow_network: bool = False) -> Iterator[RowResult]:
    """Yield the result of each row; raises `NoSandboxError` if the workspace's programs cannot be isolated."""
    for row in course.rows():
        with tempfile.TemporaryDirectory(prefix="bc-grade-", ignore_cleanup_errors=True) as folder:
            sandbox = make_sandbox(workspace, Path(folder), allow_network=allow_network)
            yield RowResult(row, _failure(row, sandbox, course))


def _failure(row: GradeRow, sandbox: Sandbox, course: Course) -> str:
    files = WorkspaceFiles(sandbox.workspace)
    names = {**course.defaults, "package": files.package_name(course.defaults.get("package", ""))}
    for condition in row.files:
        if why := missing(condition, Activity(), files, names):
            return why.replace(f"{sandbox.workspace}", "the workspace")
    if not files.packages and _starts_package(row):
        return NO_PACKAGE  # otherwise an installed package of the same name would be graded
    if row.script and (why := _script(row, sandbox, names)):
        return why
    return next((why for each in row.drives if (why := _drive(each, sandbox, names))), "")


def _starts_package(row: GradeRow) -> bool:
    lines = [*row.starts, *(each.words for each in row.drives)]
    return any("{package}" in word for words in lines for word in words)


def _script(row: GradeRow, sandbox: Sandbox, names: dict[str, str]) -> str:
    (sandbox.folder / "home" / "script").write_text(with_names(row.script, names), encoding="utf-8")
    starts = " ".join(f"--start {shlex.quote(_line(words, names))}" for words in row.starts)
    done = sandbox.run(CHECK.format(starts=starts, wait=NODES_TIMEOUT_S, seed=SEED), ROW_TIMEOUT_S)
    report = _report(sandbox)
    if report is None:
        return done.why or _explained("the nodes did not start", done)
    failed = next((each for each in report["steps"] if not each["ok"]), None)
    if failed is None:
        return done.why
    why = f"{failed['text']}: {failed['why']}"
    return _explained(why, done) if failed["why"].startswith(NOT_REACHED) else why


def _drive(drive: Drive, sandbox: Sandbox, names: dict[str, str]) -> str:
    line = DRIVE.format(seed=SEED, seconds=drive.seconds, words=_line(drive.words, names))
    done = sandbox.run(line, ROW_TIMEOUT_S)
    report = _report(sandbox)
    if done.why or report is None or "distance" not in report:
        return done.why or _explained("the run produced no report", done)
    distance = float(report["distance"])
    return (
        ""
        if distance > drive.metres
        else f"the robot drove {distance:.2f} m in {drive.seconds} s, not {drive.metres:g} m"
    )


def _line(words: Sequence[str], names: dict[str, str]) -> str:
    return " ".join(shlex.quote(with_names(each, names)) for each in words)


def _report(sandbox: Sandbox) -> dict[str, Any] | None:
    try:
        found: Any = json.loads(_text(sandbox.folder / "home" / "report"))
    except ValueError:
        return None
    return cast("dict[str, Any]", found) if isinstance(found, dict) else None


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _explained(why: str, done: RunResult) -> str:
    lines = [each.strip() for each in done.output.splitlines() if each.strip()]
    return f"{why} ({' / '.join(lines[-EXPLAINING_LINES:])})" if lines else why


def row_text(result: RowResult) -> str:
    """A row of the printed table: passed or not, points, title, and why it failed."""
    mark = "FAIL" if result.failed else "-   " if result.why else "ok  "
    plus = "+" if result.row.extra else ""
    why = f"\n           {result.why}" if result.why else ""
    return f"{mark}  {result.points:g}/{plus}{result.row.points:g}  {result.row.title}{why}"


def sum_text(results: Sequence[RowResult]) -> str:
    """The sum of the points, and separately that of the extra points, if there are any."""
    extra = f", {_points(results, extra=True):g} of {_max_points(results, extra=True):g} extra points"
    has_extra = any(each.row.extra for each in results)
    return f"{_points(results):g} of {_max_points(results):g} points{extra if has_extra else ''}"


def _points(results: Sequence[RowResult], *, extra: bool = False) -> float:
    return sum(each.points for each in results if each.row.extra == extra)


def _max_points(results: Sequence[RowResult], *, extra: bool = False) -> float:
    return sum(each.row.points for each in results if each.row.extra == extra)


def as_json(course: Course, results: Sequence[RowResult]) -> dict[str, Any]:
    """The results as JSON data."""
    rows = [
        {
            "title": each.row.title,
            "ok": not each.why,
            "why": each.why,
            "points": each.points,
            "of": each.row.points,
            "extra": each.row.extra,
        }
        for each in results
    ]
    points = {"points": _points(results), "extra_points": _points(results, extra=True)}
    return {"course": course.name, **points, "rows": rows}


def as_junit(course: Course, results: Sequence[RowResult]) -> str:
    """The results as a JUnit report; rows with extra points that failed are skipped tests."""
    failures, skipped = sum(each.failed for each in results), sum(each.row.extra and bool(each.why) for each in results)
    counts = {"tests": str(len(results)), "failures": str(failures), "skipped": str(skipped)}
    suite = ElementTree.Element("testsuite", {"name": course.name, **counts})
    for each in results:
        case = ElementTree.SubElement(suite, "testcase", classname=course.name, name=each.row.title)
        if each.why:
            ElementTree.SubElement(case, "failure" if each.failed else "skipped", message=_printable(each.why))
    return ElementTree.tostring(suite, encoding="unicode")


def _printable(text: str) -> str:
    return "".join(each if each.isprintable() or each == "\n" else "?" for each in text)
