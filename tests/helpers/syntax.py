"""The statements of a source file: to look into expressions as well, as `ast.walk` does, takes much longer."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

INSIDE = ("body", "orelse", "finalbody", "handlers", "cases")
"""Where a statement has other statements, and handlers and cases that have some."""


def statements(path: Path) -> Iterator[ast.AST]:
    """Every statement of a file, those within others included."""
    waiting: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"))]
    while waiting:
        each = waiting.pop()
        yield each
        for name in INSIDE:
            inner = getattr(each, name, None)
            if isinstance(inner, list):  # the body of a lambda is an expression
                waiting += inner
