"""The limits of the style guide: how much a reader has to keep in mind at once."""

import ast
import runpy
from pathlib import Path

import pytest
from syntax import statements

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("tui", "runtime", "nodes", "launch", "tools")
FILE_LIMIT = 500
FUNCTION_LIMIT = 60
MAX_ANY_PER_1000_LINES = 20
"""Uses of `Any` in the runtime, rounded: the remaining ones can be anything, or are checked when the program runs."""
FILES = sorted(
    path
    for folder in (*SOURCES, "tests/helpers")
    for path in (ROOT / folder).rglob("*.py")
    if "generated" not in path.parts
)


def test_files_are_found():
    assert len(FILES) > 500


@pytest.mark.parametrize("folder", (*SOURCES, "tests/helpers"))
def test_no_file_exceeds_the_limit(folder):
    inside = [path for path in FILES if path.is_relative_to(ROOT / folder)]
    long = {str(path.relative_to(ROOT)): n for path in inside if (n := len(path.read_text().splitlines())) > FILE_LIMIT}
    assert not long


@pytest.mark.parametrize("folder", (*SOURCES, "tests/helpers"))
def test_no_function_exceeds_the_limit(folder):
    long = {}
    inside = (path for path in FILES if path.is_relative_to(ROOT / folder))
    for path in (path for path in inside if path.read_bytes().count(b"\n") > FUNCTION_LIMIT):
        for node in statements(path):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = (node.end_lineno or node.lineno) - node.lineno + 1
                if lines > FUNCTION_LIMIT:
                    long[f"{path.relative_to(ROOT)}:{node.lineno} {node.name}"] = lines
    assert long == {}


@pytest.mark.slow
def test_runtime_does_not_use_any_more_often():
    density = runpy.run_path(str(ROOT / "tools/figures.py"))["any_density"](ROOT)
    assert round(density) <= MAX_ANY_PER_1000_LINES
