"""What the doctor says: how a thing is, and how to mend it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from enum import Enum
from typing import Any


class Level(str, Enum):
    """How bad it is; only `FAIL` makes the exit code 1."""

    OK = "ok"
    NOTE = "note"
    WARN = "warn"
    FAIL = "fail"


MARKS = {Level.OK: "✓", Level.NOTE: "·", Level.WARN: "!", Level.FAIL: "✗"}


@dataclass(frozen=True)
class Finding:
    """One line; `mend` says what to do, empty where nothing is to be done."""

    level: Level
    about: str
    text: str
    mend: str = ""

    def line(self) -> str:
        """As a person reads it; the word stands beside the mark for whoever does not see either's colour."""
        word = "" if self.level in (Level.OK, Level.NOTE) else f"{self.level.value.upper()}: "
        mend = f"\n    → {self.mend}" if self.mend else ""
        return f"{MARKS[self.level]} {self.about:<10} {word}{self.text}{mend}"


def as_json(findings: Iterable[Finding]) -> list[dict[str, Any]]:
    """As a script reads it."""
    return [{**asdict(each), "level": each.level.value} for each in findings]


def exit_code(findings: Iterable[Finding]) -> int:
    """1 where something fails, else 0."""
    return int(any(each.level is Level.FAIL for each in findings))
