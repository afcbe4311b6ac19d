"""Imports that the fork server makes before it forks a process for a program, chosen by the program's own imports.

NumPy takes as long to import as all of rclpy. A program that does not need it starts without it; if that is unknown,
the server imports it, as otherwise each process would do so.
"""

from __future__ import annotations

import ast
import contextlib
import importlib
import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from typing import Any

from bot_console.runtime.children.own_fork_server import MEMBER_PROGRAM
from bot_console.runtime.importer import GENERATED, PACKAGES
from bot_console.runtime.process.fork_server import Job

UNKNOWN = "numpy"
"""Imported for programs whose imports are unknown."""
WITH_ARRAYS = ("rclpy.action",)
"""Modules that use NumPy, as goal IDs are arrays."""
MAX_SOURCE_BYTES = 1_000_000
"""How many bytes of source text are read at most."""

STEPPED = ("asyncio", "numpy.random", MEMBER_PROGRAM.partition(":")[0])
"""Modules that a process of a stepped run needs for the run's time, messages and random numbers."""

_seen: set[tuple[str | None, int]] = set()


def import_needed(job: Job) -> None:
    """Import the modules that a job's program will need; errors are left to the program."""
    with contextlib.suppress(Exception):  # the program encounters the error itself, and reports it
        if job.program == MEMBER_PROGRAM:
            for name in STEPPED:
                importlib.import_module(name)
        path = _source(*job.arguments[1:])
        seen = path, os.stat(path).st_mtime_ns if path else 0
        if seen not in _seen:
            _seen.add(seen)
            for name in _modules_needed(path) if path else (UNKNOWN,):
                with contextlib.suppress(Exception):
                    importlib.import_module(name)


def _source(function: str, arguments: Sequence[Any]) -> str | None:
    """Return the file of a program (see `workspace.launched`); None if it is not found."""
    kind = function.rpartition(":")[2]
    if kind == "python_file":
        return arguments[1]
    if kind == "entry_point":
        module = arguments[1].partition(":")[0].strip().split(".")
        places = (os.path.join(folder, *module) + ".py" for folder in arguments[2])
        return next(filter(os.path.isfile, places), None)
    return None


def _modules_needed(path: str) -> Iterator[str]:
    """Yield the modules to import for a file."""
    with open(path, "rb") as file:
        text = file.read(MAX_SOURCE_BYTES + 1)
    if len(text) > MAX_SOURCE_BYTES:
        yield UNKNOWN
        return
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return  # the program will not run
    for each in ast.walk(tree):
        if isinstance(each, ast.Import):
            for alias in each.names:
                yield from _of_module(alias.name)
        elif isinstance(each, ast.ImportFrom):
            module = each.module or ""
            yield from _of_module(module, [alias.name for alias in each.names]) if not each.level else (UNKNOWN,)


def _of_module(module: str, names: Sequence[str] = ()) -> Iterator[str]:
    top, _, kind = module.partition(".")
    if top in sys.stdlib_module_names:
        return
    if top in PACKAGES and module not in WITH_ARRAYS:
        yield module
    elif (
        kind not in ("msg", "srv")
        or not os.path.isdir(os.path.join(GENERATED, top))
        or not _create_one_of_each(module, names)
    ):
        yield from (UNKNOWN, module) if module in WITH_ARRAYS else (UNKNOWN,)


def _create_one_of_each(module: str, names: Sequence[str]) -> bool:
    """Create an object of each interface, which imports NumPy for fixed-size arrays; return whether all are known."""
    for name in names:
        cls = getattr(importlib.import_module(module), name, None)
        if cls is None:
            return False
        for part in (cls.Request, cls.Response) if module.endswith(".srv") else (cls,):
            part()
    return bool(names)
