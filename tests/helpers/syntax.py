"""What a source file says, without `ast.walk` over all of it, which takes much longer than any of these."""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Iterator
from pathlib import Path

INSIDE = ("body", "orelse", "finalbody", "handlers", "cases")
"""Fields in which a statement contains other statements, or handlers and cases that do."""
NO_CODE = re.compile(
    r"""('{3}|"{3})(?:\\.|(?!\1).)*\1|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|\#[^\n]*""",
    re.DOTALL,
)
IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+[.\w]+[ \t]+import[ \t]*(?:\([^)]*\)|[^\n]+)|import[ \t]+[^\n]+)", re.MULTILINE
)
FUNCTION = re.compile(r"( *)(?:async )?def ")


def statements(path: Path) -> Iterator[ast.AST]:
    """Every statement of a file, including nested ones; unlike `ast.walk`, without expressions."""
    waiting: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"))]
    while waiting:
        each = waiting.pop()
        yield each
        for name in INSIDE:
            inner = getattr(each, name, None)
            if isinstance(inner, list):  # the body of a lambda is an expression
                waiting += inner


def code(text: str) -> str:
    """A source without what its strings and comments contain, line by line."""
    return NO_CODE.sub(lambda found: "" if found[0][0] == "#" else '""' + "\n" * found[0].count("\n"), text)


def imports(path: Path) -> list[ast.Import | ast.ImportFrom]:
    """All import statements of a file, also nested ones: to parse only these takes half of the time."""
    found = IMPORT.findall(code(path.read_text(encoding="utf-8")))
    parsed = ast.parse("\n".join(textwrap.dedent(each) for each in found)).body
    return [each for each in parsed if isinstance(each, ast.Import | ast.ImportFrom)]


def may_have_function_above(limit: int, text: str) -> bool:
    """Whether a function of a source may have more lines: each ends before the next line that is not further inside."""
    lines = code(text).splitlines()
    begun: list[tuple[int, int]] = []
    for number, line in enumerate([*lines, "end"]):
        inside = len(line) - len(line.lstrip())
        if line.strip() and not line.lstrip().startswith((")", "]", "}", '""')):
            while begun and begun[-1][0] >= inside:
                if number - begun.pop()[1] > limit:
                    return True
        if found := FUNCTION.match(line):
            begun.append((len(found[1]), number))
    return False
