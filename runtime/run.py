"""Runs one node as the main program of this process: `bot-console run FILE.py | PACKAGE EXECUTABLE [--ros-args ...]`.

Nothing is virtual here: the node has the real main thread, signals and standard streams.
"""

from __future__ import annotations

import ast
import importlib
import runpy
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

from bot_console.runtime.importer import install
from bot_console.runtime.workspace.executables import Executable, executables

HERE = str(Path(__file__).resolve().parent)


def main(argv: Sequence[str] | None = None) -> int:
    """Run what the words name and give its exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    install()
    if not words:
        return _refuse("name a file or a package: bot-console run FILE.py, or bot-console run PACKAGE EXECUTABLE")
    if words[0].endswith(".py") or Path(words[0]).is_file():
        return run_file(Path(words[0]), words[1:])
    if len(words) == 1:
        return _refuse(f"'{words[0]}' is no file here; for a package name the executable as well")
    return run_package(words[0], words[1], words[2:])


def run_package(package: str, name: str, words: Sequence[str]) -> int:
    """Run an executable of a package."""
    from ament_index_python.packages import PackageNotFoundError

    try:
        found = executables(package)
    except (PackageNotFoundError, ValueError):
        return _refuse(f"Package '{package}' not found")
    if name not in found:
        choices = ", ".join(sorted(found)) or "none"
        return _refuse(f"No executable found: '{name}' is not in package '{package}', which has: {choices}")
    executable = found[name]
    if executable.entry_point:
        return run_entry_point(executable, words)
    if executable.path and _is_python(executable.path):
        return run_file(executable.path, words)
    from ros2cli.verbs.run import run

    return run(executable, list(words))


def run_file(path: Path, words: Sequence[str]) -> int:
    """Run a Python file as `python FILE` does, with the embedded runtime behind the ROS names."""
    if not path.is_file():
        return _refuse(f"{path} does not exist")
    problem, hint = examine(path)
    if problem:
        return _refuse(problem)
    if hint:
        print(f"[WARN] [bot-console]: {hint}", file=sys.stderr)
    sys.argv = [str(path), *words]
    sys.path.insert(0, str(path.resolve().parent))
    return _guarded(lambda: runpy.run_path(str(path), run_name="__main__"))


def run_entry_point(executable: Executable, words: Sequence[str]) -> int:
    """Run a console script's function; what it returns is the exit code, as setuptools' scripts do it."""
    entry = executable.entry_point
    if entry is None:
        raise ValueError(f"{executable} has no entry point")
    sys.argv = [executable.name, *words]

    def start() -> None:
        function = getattr(importlib.import_module(entry.module), entry.function)
        sys.exit(function())

    return _guarded(start)


def _guarded(start: object) -> int:
    """Run to the end; a traceback begins in the user's own file."""
    try:
        start()  # type: ignore[operator]
    except SystemExit as stop:
        if isinstance(stop.code, str):
            print(stop.code, file=sys.stderr)
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except KeyboardInterrupt as error:
        _print_traceback(error)
        return 130
    except Exception as error:  # the border to the user's program
        _print_traceback(error)
        return 1
    return 0


def _print_traceback(error: BaseException) -> None:
    error.__traceback__ = _trimmed(error.__traceback__)
    sys.stdout.flush()
    traceback.print_exception(type(error), error, error.__traceback__)


def _trimmed(trace: TracebackType | None) -> TracebackType | None:
    """Without the frames of this file and of runpy that stand before the user's."""
    first = trace
    while trace and (trace.tb_frame.f_code.co_filename == __file__ or "runpy" in trace.tb_frame.f_code.co_filename):
        trace = trace.tb_next
    return trace or first


def examine(path: Path) -> tuple[str, str]:
    """Why a file cannot be run, and what its reader should know; each empty when there is nothing to say."""
    try:
        tree = ast.parse(path.read_bytes(), str(path))
    except SyntaxError as error:
        return f"{path}:{error.lineno}: {error.msg}", ""
    except ValueError as error:
        return f"{path} is not a Python file: {error}", ""
    mains = [each for each in tree.body if isinstance(each, ast.FunctionDef) and each.name == "main"]
    if len(mains) > 1:
        lines = ", ".join(str(each.lineno) for each in mains)
        return "", f"{path} defines main() {len(mains)} times (lines {lines}); Python keeps the last one"
    quiet = (ast.Import, ast.ImportFrom, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef, ast.Assign, ast.AnnAssign)
    acting = [each for each in tree.body if not isinstance(each, quiet) and not _is_text(each)]
    if acting:
        return "", ""
    mend = "call main() below `if __name__ == '__main__':`" if mains else "give it a main() that makes and spins the node"
    return "", f"{path} only defines things, so running it does nothing; {mend}"


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _is_python(path: Path) -> bool:
    with path.open("rb") as file:
        first = file.readline(200)
    return path.suffix == ".py" or (first.startswith(b"#!") and b"python" in first)


def _refuse(text: str) -> int:
    print(text, file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
