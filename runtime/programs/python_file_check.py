"""Inspects a Python file before it is run as a node: whether it starts anything, and what to say if not."""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bot_console.runtime.programs.qt_plugins import QT_PLUGIN, imports_qt

QUIET = (ast.Import, ast.ImportFrom, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef, ast.Assign, ast.AnnAssign)
"""Statements that only define something."""


class PlainFile(NamedTuple):
    """`problem` says why a file cannot be run, `hint` what the user should know; empty if there is nothing to say."""

    problem: str = ""
    hint: str = ""
    calls_main: bool = False
    """Whether `main()` has to be called because the file does not call it."""


def examine(path: Path) -> PlainFile:
    """Inspect a file without running it."""
    try:
        tree = ast.parse(path.read_bytes(), str(path))
    except SyntaxError as error:
        return PlainFile(f"{path}:{error.lineno}: {error.msg}")
    except ValueError as error:
        return PlainFile(f"{path} is not a Python file: {error}")
    except (MemoryError, RecursionError):
        return PlainFile(f"{path} is nested too deeply for Python")
    if imports_qt(tree):
        return PlainFile(QT_PLUGIN.format(path))
    mains = [each for each in tree.body if isinstance(each, ast.FunctionDef) and each.name == "main"]
    hint = ""
    if len(mains) > 1:
        lines = ", ".join(str(each.lineno) for each in mains)
        hint = (
            f"{path} defines main() {len(mains)} times (lines {lines}); the last one counts. Keep one, or give the "
            "others names of their own"
        )
    if any(not isinstance(each, QUIET) and not _is_text(each) for each in tree.body):
        return PlainFile(hint=hint)
    return PlainFile(hint=hint, calls_main=True) if mains else PlainFile(_no_main(path, tree))


def run_then_main(runs: Callable[[], object]) -> Callable[[], None]:
    """Return a function that runs a file and then the `main()` it defines, as `ros2 run` would."""

    def run() -> None:
        runs()
        sys.exit(sys.modules["__main__"].main())

    return run


def _no_main(path: Path, tree: ast.Module) -> str:
    nodes = [each.name for each in tree.body if isinstance(each, ast.ClassDef) and _is_node(each)]
    made = f"{nodes[0]}()" if nodes else "YourNode()"
    also = f" It has the node classes {', '.join(nodes)}." if len(nodes) > 1 else ""
    return (
        f"{path} has no main() and starts nothing, so there is nothing to run (ros2 run cannot start it either).{also} "
        f"Add: def main(): rclpy.init(); rclpy.spin({made}) - and below it: if __name__ == '__main__': main()"
    )


def _is_node(definition: ast.ClassDef) -> bool:
    return any(ast.unparse(each).endswith("Node") for each in definition.bases)


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
