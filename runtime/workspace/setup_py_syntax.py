"""Finds mistakes that prevent a `setup.py` from running, without running it."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator
from typing import cast

ALWAYS_THERE = frozenset(dir(builtins)) | {"__file__", "__builtins__", "__annotations__", "__class__", "__qualname__"}
HIDDEN_SCOPES = frozenset({"exec", "globals", "locals", "vars", "NameError"})
"""A file that uses one of these may define names invisibly, as by `exec` of a version file, or handle a missing one."""
NEVER_CALLED = (ast.Tuple, ast.List, ast.Dict, ast.Constant, ast.JoinedStr)


def first_mistake(tree: ast.Module) -> str:
    """Return the first mistake as `line N: ...`; empty if none was found.

    Finds names that nothing in the file defines, such as a module that is not imported, and a missing comma before a
    parenthesis. Python stops at both: such a package works here, but ROS 2's `colcon build` would fail.
    """
    found = sorted([*_missing_commas(tree), *_undefined(tree)])
    return f"line {found[0][0]}: {found[0][1]}" if found else ""


def _missing_commas(tree: ast.Module) -> Iterator[tuple[int, str]]:
    for each in ast.walk(tree):
        if isinstance(each, ast.Call) and isinstance(each.func, NEVER_CALLED):
            line = each.func.end_lineno or each.lineno
            yield line, f"a comma is missing after {ast.unparse(each.func)}"


def _undefined(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield names that are read but bound nowhere in the file, in whatever order, so that they certainly fail."""
    bound = set(ALWAYS_THERE)
    read: list[ast.Name] = []
    for each in _evaluated(tree):
        if isinstance(each, ast.Name):
            if isinstance(each.ctx, ast.Load):
                read.append(each)
            else:
                bound.add(each.id)
        else:
            bound.update(_bound_by(each))
    # the names that this import provides are unknown
    if "*" in bound or any(name.id in HIDDEN_SCOPES for name in read):
        return
    for name in read:
        if name.id not in bound:
            yield name.lineno, f"name '{name.id}' is not defined{_import_of(name.id)}"


def _evaluated(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and all nodes below it, except annotations, of which only some are evaluated."""
    yield node
    for name, below in ast.iter_fields(node):
        if name not in ("annotation", "returns"):
            for each in cast("list[object]", below) if isinstance(below, list) else (below,):
                if isinstance(each, ast.AST):
                    yield from _evaluated(each)


def _bound_by(node: ast.AST) -> Iterator[str]:
    """Yield the names that nodes other than names bind: imports, arguments, definitions, exceptions, `match`."""
    if isinstance(node, ast.alias):
        yield node.asname or node.name.partition(".")[0]
    elif isinstance(node, ast.arg):
        yield node.arg
    else:
        yield from (each for each in (getattr(node, "name", None), getattr(node, "rest", None)) if each)


def _import_of(name: str) -> str:
    """Return the import statement of a name that setup files of ROS packages commonly use."""
    lines = {"os": "import os", "glob": "from glob import glob", "setup": "from setuptools import setup"}
    lines["find_packages"] = "from setuptools import find_packages"
    return f"; add `{lines[name]}`" if name in lines else ""
