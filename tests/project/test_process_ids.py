"""The middleware uses the real process id: in a node that is a thread, `os.getpid` returns a made-up one."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def process_id_lines(text: str) -> Iterator[int]:
    """The lines that ask `os` for the process id."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Attribute) and node.attr == "getpid":
            if isinstance(node.value, ast.Name) and node.value.id == "os":
                yield node.lineno
        elif isinstance(node, ast.ImportFrom) and node.module == "os" and any(e.name == "getpid" for e in node.names):
            yield node.lineno


def test_planted_call_is_found() -> None:
    assert sorted(process_id_lines("import os\nos.getpid()\nfrom os import getpid\nreal.getpid()\n")) == [2, 3]


def test_middleware_never_asks_os_for_the_process_id() -> None:
    files = sorted((ROOT / "runtime" / "rmw").rglob("*.py"))
    assert files
    found = [f"{file}:{line}" for file in files for line in process_id_lines(file.read_text(encoding="utf-8"))]
    assert found == [], "use bot_console.runtime.process.unpatched.getpid"
