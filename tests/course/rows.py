"""The numbered rows of the course page's checks: the statement of each, and the short texts that it quotes."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

COURSE = Path(os.environ.get("BOT_CONSOLE_COURSE", "")).absolute()
"""The folder with the page's listings and `checks.md`, if the environment names one."""
LINE = re.compile(r"^\| C(\d+) \| (.*) \| (.*) \| (.*) \| *(.*?) *\|$")


@dataclass(frozen=True)
class Row:
    """One statement of the page."""

    number: int
    place: str
    kind: str
    text: str
    notes: tuple[str, ...]

    @property
    def quoted(self) -> list[str]:
        """The texts between backticks: commands, lines of output, names."""
        return [each.replace("\\|", "|") for each in re.findall(r"`([^`]*)`", self.text)]

    @property
    def command(self) -> str:
        """The command of a row that consists of one."""
        return self.quoted[0]

    def __str__(self) -> str:
        return f"C{self.number}"


@lru_cache
def rows() -> dict[int, Row]:
    """All rows by number; none if no course is named."""
    checks = COURSE / "checks.md"
    if not os.environ.get("BOT_CONSOLE_COURSE") or not checks.is_file():
        return {}
    found: dict[int, Row] = {}
    for line in checks.read_text("utf-8").splitlines():
        if match := LINE.match(line.replace("\\|", "\0")):
            number, place, kind, text, notes = (each.replace("\0", "\\|") for each in match.groups())
            found[int(number)] = Row(int(number), place, kind, text, tuple(re.findall(r"N\d+", notes)))
    return found
