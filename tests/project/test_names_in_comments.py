"""Names in backticks in docstrings and comments exist: after a renaming, old names are easily left behind there."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("tui", "runtime", "nodes", "launch", "tools", "tests")
NAME = r"[A-Za-z][A-Za-z0-9]*_[A-Za-z0-9_]*[A-Za-z0-9]"
"""A name with an underscore: a single word may be ordinary English."""
QUOTED = re.compile(rf"`(?:\w+\.)*({NAME})(?:\([^`\n]*\))?`")
ELSEWHERE = {
    "CO_COROUTINE": "of inspect",
    "SIOCGIFADDR": "of the kernel",
    "REAL_PYTHON": "an argument of tools/compare_programs.py",
    "c_lflag": "of termios(3)",
    "clip_matrix": "of upstream's tf_transformations, which tools/what_runs.py lists as missing",
    "orthogonalization_matrix": "likewise",
    "sched_autogroup_enabled": "of the kernel",
    "user_line": "of pdb",
}


def test_names_in_docstrings_and_comments_exist() -> None:
    named: dict[str, Path] = {}
    used: set[str] = set()
    for folder in SOURCES:
        for path in (ROOT / folder).rglob("*.py"):
            text, place = path.read_text(encoding="utf-8"), path.relative_to(ROOT)
            named |= dict.fromkeys(QUOTED.findall(text), place)
            used.update(re.findall(rf"\b_*{NAME}\b", QUOTED.sub("", text)), re.findall(r"\w+", str(place)))
    used |= {name.lstrip("_") for name in used}
    assert {name: path for name, path in named.items() if name not in used and name not in ELSEWHERE} == {}
