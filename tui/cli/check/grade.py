"""`bot-console check WORKSPACE --course COURSE`: grades a student's workspace."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.tui.learn.course import CourseError, find_course, read_course
from bot_console.tui.learn.grading import RowResult, as_json, as_junit, grade, row_text, sum_text
from bot_console.tui.learn.sandbox import NoSandboxError
from bot_console.tui.text.sanitize import sanitize


def run_grading(given: argparse.Namespace) -> int:
    """Grade and print the table; 0 if all rows passed, not counting extra points, 1 if not, 2 for wrong usage.

    Also returns 1 if the workspace cannot be graded.
    """
    workspace = Path(given.script).resolve()
    if not workspace.is_dir():
        print(f"there is no folder {given.script}: name the workspace that is to be graded", file=sys.stderr)
        return 2
    install()  # Checking launch files needs the installed packages.
    try:
        course = read_course(find_course(given.course))
    except CourseError as error:
        print(error, file=sys.stderr)
        return 2
    if not course.rows():
        print(f"the course '{course.name}' has no row to grade by (a fence ```grade)", file=sys.stderr)
        return 2
    try:
        results: list[RowResult] = []
        for result in grade(course, workspace, allow_network=given.allow_network):
            results.append(result)
            if not given.json:  # Each row takes some seconds, so print it at once.
                _print(row_text(result))
    except NoSandboxError as refused:
        print(refused, file=sys.stderr)
        return 1
    if given.json:
        print(json.dumps(as_json(course, results), indent=2))
    else:
        _print(sum_text(results))
    if given.junit:
        try:
            Path(given.junit).write_text(as_junit(course, results), encoding="utf-8")
        except OSError as error:
            print(f"{given.junit} is not written: {error.strerror}", file=sys.stderr)
            return 1
    return 0 if not any(each.failed for each in results) else 1


def _print(text: str) -> None:
    print("\n".join(sanitize(line) for line in text.splitlines()), flush=True)
