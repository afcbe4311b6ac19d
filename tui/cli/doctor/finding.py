"""A finding of the doctor: what was found, and how to fix it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from enum import Enum
from typing import Any


class Level(str, Enum):
    """The severity; only `FAIL` makes the exit code 1."""

    OK = "ok"
    NOTE = "note"
    WARN = "warn"
    FAIL = "fail"


MARKS = {Level.OK: "✓", Level.NOTE: "·", Level.WARN: "!", Level.FAIL: "✗"}


@dataclass(frozen=True)
class DoctorFinding:
    """One finding; `hint` says how to fix it, and is empty if there is nothing to fix."""

    level: Level
    about: str
    text: str
    hint: str = ""

    def line(self) -> str:
        """The finding as text; the word beside the mark is for those who cannot see the mark or its colour."""
        word = "" if self.level in (Level.OK, Level.NOTE) else f"{self.level.value.upper()}: "
        hint = f"\n    → {self.hint}" if self.hint else ""
        return f"{MARKS[self.level]} {self.about:<10} {word}{self.text}{hint}"


def as_json(findings: Iterable[DoctorFinding]) -> list[dict[str, Any]]:
    """The findings as JSON data."""
    # `hint` was called `mend` in earlier releases; that name is written for one more release.
    return [{**asdict(each), "level": each.level.value, "mend": each.hint} for each in findings]


def exit_code(findings: Iterable[DoctorFinding]) -> int:
    """1 if anything fails, else 0."""
    return int(any(each.level is Level.FAIL for each in findings))
