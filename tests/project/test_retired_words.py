"""Names use the field's terms: words of an earlier private vocabulary stay out of identifiers and file names."""

from __future__ import annotations

import ast
import re
import subprocess
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("tui", "runtime", "nodes", "launch", "tests", "tools")

RETIRED = {
    "anew": "again, restart",
    "baton": "scheduler",
    "dial": "tunable",
    "dials": "tunables",
    "foresee": "prefork",
    "harmless": "sanitize",
    "heed": "observe",
    "inlet": "remote subscription",
    "judged": "result",
    "knock": "connect",
    "letter": "character",
    "letters": "characters",
    "mend": "hint, fix, repair",
    "mended": "repaired",
    "mends": "hints",
    "outlet": "remote publisher",
    "patience": "timeout",
    "said": "message, output",
    "seat": "task",
    "seats": "tasks",
    "shelf": "profile store",
    "sights": "sensors",
    "tell": "report",
    "teller": "notifier",
    "tellers": "publishers",
    "tells": "reports",
    "terse": "exit messages",
    "told": "reported",
    "wish": "request",
    "wishes": "requests",
}
"""Each retired word, and what to write instead."""

RETIRED_IN_FILE_NAMES = {"apart", "declared", "door", "look", "odd", "present", "seen", "study"}
"""Words that are fine in other names, but say nothing about what a module contains."""

RETIRED_CONSTANTS = re.compile(
    r"_*(PATIENCE|MOST|BEAT)(_|$)|_*LOOKS?(_M?S)?$|.*_(PATIENCE|LOOKS?)(_|$)|_*(LARGEST|LONGEST|LEAST|FEWEST)$"
)
"""Constants say what they limit and in which unit: `ANSWER_TIMEOUT_S`, `MAX_ROWS`, `GRAPH_POLL_S`."""

ALLOWED = {"harmless"}
"""Words that the names of tests may contain in their ordinary English sense."""

PUBLIC = {"action_letters", "let_go"}
"""Names that users write in their settings or plug-ins."""


def words(name: str) -> set[str]:
    """The words of a snake_case, camelCase or CONSTANT_CASE name, in lower case."""
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)}


def files() -> list[Path]:
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.py"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if listed.returncode == 0:
        found = [ROOT / line for line in listed.stdout.splitlines()]
    else:  # a copy without a repository
        found = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")]
    own = [path for path in found if path.relative_to(ROOT).parts[0] in FOLDERS and path.is_file()]
    return [path for path in own if "generated" not in path.parts]


def defined(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """Every name that a module defines itself, with its line."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.name, node.lineno
        elif isinstance(node, ast.arg):
            yield node.arg, node.lineno
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id, node.lineno
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr, node.lineno


@cache
def retired(name: str) -> set[str]:
    """The retired words of a name."""
    found = set() if name in PUBLIC else words(name) & set(RETIRED)
    if name.startswith("test_"):
        found -= ALLOWED
    if RETIRED_CONSTANTS.match(name) and name.isupper():
        found.add(name)
    return found


def retired_names(text: str) -> list[tuple[str, int]]:
    """The retired names that a source text defines, with their lines."""
    if not any(map(retired, set(re.findall(r"\w+", text)))):  # quicker than parsing
        return []
    return sorted({(name, line) for name, line in defined(ast.parse(text)) if retired(name)})


def test_names_contain_no_retired_words() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {name} ({', '.join(sorted(retired(name)))})"
        for path in files()
        for name, line in retired_names(path.read_text(encoding="utf-8"))
    ]
    assert not found, "\n".join(found)


def test_file_names_contain_no_retired_words() -> None:
    banned = set(RETIRED) | RETIRED_IN_FILE_NAMES
    found = [
        str(path.relative_to(ROOT))
        for path in files()
        if banned & words(path.relative_to(ROOT).as_posix().replace(".py", "")) - {"s"}
    ]
    assert not found, "\n".join(found)


def test_planted_names_are_found() -> None:
    text = "class Shelf:\n    def tell_all(self, wish, max_rows=1):\n        self.mended = wish\nPATIENCE_S = 1\n"
    found = {name for name, _ in retired_names(text)}
    assert found == {"Shelf", "tell_all", "wish", "mended", "PATIENCE_S"}
