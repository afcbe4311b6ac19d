"""Mistakes with which a `setup.py` cannot be run, found without running it."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator

ALWAYS_THERE = frozenset(dir(builtins)) | {"__file__", "__builtins__", "__annotations__", "__class__", "__qualname__"}
HIDDEN_SCOPES = frozenset({"exec", "globals", "locals", "vars", "NameError"})
"""What a file reads that defines names without writing them, as `exec` of a version file, or can do without one."""
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
    for each in _evaluated(tree):
        if isinstance(each, ast.Name):
            if isinstance(each.ctx, ast.Load):
                read.append(each)
            else:
                bound.add(each.id)
        else:
            bound.update(_bound_by(each))
    if "*" in bound or any(name.id in HIDDEN_SCOPES for name in read):  # which names that brings is not known here
        return
    for name in read:
        if name.id not in bound:
            yield name.lineno, f"name '{name.id}' is not defined{_import_of(name.id)}"


def _evaluated(node: ast.AST) -> Iterator[ast.AST]:
    """A node and all below it, except for annotations: of those only some are evaluated."""
    yield node
    for name, below in ast.iter_fields(node):
        if name not in ("annotation", "returns"):
            for each in below if isinstance(below, list) else (below,):
                if isinstance(each, ast.AST):
                    yield from _evaluated(each)


def _bound_by(node: ast.AST) -> Iterator[str]:
    """The names bound by a node that is no name: imports, arguments, definitions, exceptions, captures of `match`."""
    if isinstance(node, ast.alias):
        yield node.asname or node.name.partition(".")[0]
    elif isinstance(node, ast.arg):
        yield node.arg
    else:
        yield from (each for each in (getattr(node, "name", None), getattr(node, "rest", None)) if each)


def _import_of(name: str) -> str:
    """How to import what the setup files of ROS packages use."""
    lines = {"os": "import os", "glob": "from glob import glob", "setup": "from setuptools import setup"}
    lines["find_packages"] = "from setuptools import find_packages"
    return f"; add `{lines[name]}`" if name in lines else ""
