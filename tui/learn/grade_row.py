"""The rows of a grading: what to start, the script of `bot-console check` to run on it, and simulated runs. Pure."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from bot_console.tui.cli.check.script import read as read_script
from bot_console.tui.cli.check.stepped import USAGE
from bot_console.tui.learn.condition_syntax import VERBS, Condition, read_condition

STARTERS = ("run", "launch")
"""The first words of lines that start something."""
DRIVE = re.compile(r"drive (\d+) s (.+?) (?:>|more than) (\d+(?:\.\d+)?) m")
DRIVE_USAGE = "drive SECONDS s PACKAGE FILE [NAME:=VALUE ...] > METRES m"


class Drive(NamedTuple):
    """A run in simulated time with a fixed seed: how long, what is launched, and how far the robot has to drive (m)."""

    seconds: int
    words: tuple[str, ...]
    metres: float


@dataclass(frozen=True)
class GradeRow:
    """A row: its points, conditions on files, what to start, the script that is run on it, and simulated runs."""

    title: str
    points: float
    files: tuple[Condition, ...] = ()
    starts: tuple[tuple[str, ...], ...] = ()
    script: str = ""
    drives: tuple[Drive, ...] = ()
    line: int = 0
    extra: bool = False
    """Whether it gives extra points, without which a workspace passes too."""


def read_grade_row(about: str, body: Sequence[str], line: int) -> GradeRow:
    """Parse a fence `grade POINTS Title`, or `grade +POINTS Title` for extra points.

    Raises `ValueError` with the line number of a mistake.
    """
    head, _, title = about.partition(" ")
    try:
        points = float(head)
    except ValueError:
        raise ValueError(f"{line}: write ```grade POINTS Title") from None
    starts: list[tuple[str, ...]] = []
    files: list[Condition] = []
    steps: list[str] = []
    drives: list[Drive] = []
    for number, text in enumerate(body, line + 1):
        stripped = text.strip()
        word = stripped.partition(" ")[0]
        if not stripped or stripped.startswith("#"):
            continue
        if word in STARTERS:
            starts.append(_words(stripped, number))
            if len(starts[-1]) < 3:
                raise ValueError(f"{number}: {USAGE}")
        elif word == "drive":
            drives.append(_drive(stripped, number))
        elif word in VERBS and word.startswith("expect-"):
            files.append(read_condition(stripped, number))
        else:
            steps.append(_step(stripped, number))
    if steps and not starts:
        raise ValueError(f"{line}: nothing is started: begin with `run PACKAGE EXECUTABLE` or `launch PACKAGE FILE`")
    if not (steps or files or drives):
        raise ValueError(f"{line}: the row checks nothing")
    return GradeRow(
        title.strip(),
        points,
        tuple(files),
        tuple(starts),
        "\n".join(steps),
        tuple(drives),
        line,
        extra=head.startswith("+"),
    )


def _words(text: str, line: int) -> tuple[str, ...]:
    try:
        return tuple(shlex.split(text))
    except ValueError as error:
        raise ValueError(f"{line}: {error}; put words that contain blanks or quotes into quotes") from None


def _drive(text: str, line: int) -> Drive:
    found = DRIVE.fullmatch(text)
    if found is None:
        raise ValueError(f"{line}: write {DRIVE_USAGE}")
    return Drive(int(found[1]), _words(found[2], line), float(found[3]))


def _step(text: str, line: int) -> str:
    try:
        read_script(text)
    except ValueError as error:
        raise ValueError(f"{line}: {str(error).partition(': ')[2] or error}") from None
    return text
