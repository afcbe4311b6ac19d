"""The constants that docstrings and comments name exist: a renamed one is easily left behind in them."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("tui", "runtime", "nodes", "launch", "tools", "tests")
QUOTED = re.compile(r"`([A-Z][A-Z0-9]*_[A-Z0-9_]*[A-Z0-9])`")
ELSEWHERE = {
    "SIOCGIFADDR": "of the kernel",
    "REAL_PYTHON": "an argument of tools/compare_programs.py",
}


def test_constants_in_docstrings_and_comments_exist() -> None:
    named: dict[str, Path] = {}
    used: set[str] = set()
    for folder in SOURCES:
        for path in (ROOT / folder).rglob("*.py"):
            text = path.read_text(encoding="utf-8")
            named |= dict.fromkeys(QUOTED.findall(text), path.relative_to(ROOT))
            used.update(re.findall(r"(?<!`)\b[A-Z][A-Z0-9_]*_[A-Z0-9_]+\b(?!`)", text))
    assert {name: path for name, path in named.items() if name not in used and name not in ELSEWHERE} == {}
