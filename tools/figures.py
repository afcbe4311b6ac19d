"""Counts what a reader has to keep in mind: `python tools/figures.py [COMMIT]`, for the working tree or a commit.

Generated modules are not counted. `Any` is counted as a name in code, per 1,000 lines of the runtime; a late import is
one inside a function.
"""

from __future__ import annotations

import ast
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ("tui", "runtime", "nodes", "launch", "tools")


def python_files(root: Path, folders: Sequence[str] = SOURCES) -> Iterator[Path]:
    """The Python files of the project, without tests and generated modules."""
    for folder in folders:
        for path in sorted((root / folder).rglob("*.py")):
            if not {"generated", "__pycache__"} & set(path.parts):
                yield path


def late_imports(tree: ast.Module) -> int:
    """The number of import statements inside functions."""
    functions = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef)]
    inside = {
        id(node) for each in functions for node in ast.walk(each) if isinstance(node, ast.Import | ast.ImportFrom)
    }
    return len(inside)


def any_density(root: Path) -> float:
    """How often `Any` is used, per 1,000 lines of the runtime."""
    lines = uses = 0
    for path in python_files(root, ("runtime",)):
        text = path.read_text(encoding="utf-8")
        lines += text.count("\n")
        if "Any" in text:
            uses += sum(isinstance(node, ast.Name) and node.id == "Any" for node in ast.walk(ast.parse(text)))
    return 1000 * uses / lines


def figures(root: Path) -> dict[str, float]:
    """All counts for the sources in a folder."""
    lines = late = 0
    files = list(python_files(root))
    for path in files:
        text = path.read_text(encoding="utf-8")
        lines += text.count("\n")
        late += late_imports(ast.parse(text))
    return {
        "lines": lines,
        "files": len(files),
        "folders": len({path.parent for path in files}),
        "files of at most 30 lines": sum(len(path.read_text().splitlines()) <= 30 for path in files),
        "late imports": late,
        "Any per 1,000 lines of the runtime": round(any_density(root), 1),
    }


def main(words: list[str]) -> None:
    """Print the figures."""
    if not words:
        found = figures(ROOT)
    else:
        with tempfile.TemporaryDirectory() as folder:
            packed = subprocess.run(["git", "archive", words[0], *SOURCES], cwd=ROOT, check=True, capture_output=True)
            archive = Path(folder) / "sources.tar"
            archive.write_bytes(packed.stdout)
            with tarfile.open(archive) as tar:
                tar.extractall(folder, filter="data")
            found = figures(Path(folder))
    for name, value in found.items():
        print(f"{name}: {value:g}")


if __name__ == "__main__":
    main(sys.argv[1:])
