"""The statements of a source file; unlike `ast.walk`, which takes much longer, without expressions."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

INSIDE = ("body", "orelse", "finalbody", "handlers", "cases")
"""Fields in which a statement contains other statements, or handlers and cases that do."""


def statements(path: Path) -> Iterator[ast.AST]:
    """Every statement of a file, including nested ones."""
    waiting: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"))]
    while waiting:
        each = waiting.pop()
        yield each
        for name in INSIDE:
            inner = getattr(each, name, None)
            if isinstance(inner, list):  # the body of a lambda is an expression
                waiting += inner
