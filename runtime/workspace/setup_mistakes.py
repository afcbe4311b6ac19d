"""Mistakes with which a `setup.py` cannot be run, found without running it."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator

ALWAYS_THERE = frozenset(dir(builtins)) | {"__file__", "__name__", "__doc__"}
NEVER_CALLED = (ast.Tuple, ast.List, ast.Dict, ast.Constant, ast.JoinedStr)


def first_mistake(tree: ast.Module) -> str:
    """The line and what is wrong there, as `line N: ...`; empty if nothing was found.

    Found are names that nothing in the file defines, as of a module that is not imported, and a comma that is missing
    before a parenthesis. Python stops at both: here such a package would work, and `colcon build` of ROS 2 would fail.
    """
    found = sorted([*_missing_commas(tree), *_undefined(tree)])
    return f"line {found[0][0]}: {found[0][1]}" if found else ""


def _missing_commas(tree: ast.Module) -> Iterator[tuple[int, str]]:
    for each in ast.walk(tree):
        if isinstance(each, ast.Call) and isinstance(each.func, NEVER_CALLED):
            line = each.func.end_lineno or each.lineno
            yield line, f"a comma is missing behind {ast.unparse(each.func)}"


def _undefined(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Names that are read and bound nowhere in the file, in whatever order: those that certainly fail."""
    bound = set(ALWAYS_THERE)
    read: list[ast.Name] = []
    for each in ast.walk(tree):
        if isinstance(each, ast.alias):
            if each.name == "*":  # which names that brings is not known here
                return
            bound.add(each.asname or each.name.partition(".")[0])
        elif isinstance(each, ast.Name):
            if isinstance(each.ctx, ast.Load):
                read.append(each)
            else:
                bound.add(each.id)
        elif isinstance(each, ast.arg):
            bound.add(each.arg)
        elif isinstance(each, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)) or (
            isinstance(each, ast.ExceptHandler) and each.name
        ):
            bound.add(str(each.name))
    for name in read:
        if name.id not in bound:
            yield name.lineno, f"name '{name.id}' is not defined{_import_of(name.id)}"


def _import_of(name: str) -> str:
    """How to import what the setup files of ROS packages use."""
    lines = {"os": "import os", "glob": "from glob import glob", "setup": "from setuptools import setup"}
    lines["find_packages"] = "from setuptools import find_packages"
    return f"; add `{lines[name]}`" if name in lines else ""
