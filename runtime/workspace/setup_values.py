"""Evaluates expressions in a `setup.py` without running it."""

from __future__ import annotations

import ast
import glob
import operator
import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

PLAIN: Mapping[str, Callable[[Any], Any]] = {"str": str, "list": list, "sorted": sorted, "len": len, "Path": Path}
PATHS: Mapping[str, Callable[[Any], Any]] = {
    "basename": os.path.basename,
    "dirname": os.path.dirname,
    "splitext": os.path.splitext,
}
OF_TEXTS = frozenset(
    {"endswith", "format", "join", "lower", "lstrip", "removeprefix", "removesuffix", "replace", "rstrip", "split"}
    | {"startswith", "strip"}
)
FORMATTED = re.compile(r"\{[^{}]*[:!.\[]")
"""A replacement field with more than a name, such as a width, which could require any amount of memory."""
COMPARED: Mapping[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.In: lambda one, several: one in several,
    ast.NotIn: lambda one, several: one not in several,
}


class Unreadable(ValueError):
    """An expression that can be evaluated only by running the file; the message says which expression and where."""


def called_name(call: ast.Call) -> str:
    """Return the last part of the name of the called function."""
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


class Values:
    """Evaluates expressions as far as possible without running code."""

    def __init__(self, folder: Path, names: dict[str, Any]) -> None:
        self.names = names
        self._folder = folder

    def of(self, node: ast.expr) -> Any:
        """Return the value of an expression; raises `Unreadable`."""
        method: Callable[[ast.expr], object] | None = getattr(self, f"_{type(node).__name__.lower()}", None)
        if method is None:
            raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")
        try:
            return method(node)
        except (TypeError, LookupError, ValueError, AttributeError) as error:
            if isinstance(error, Unreadable):
                raise
            raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}: {error}") from None

    def _constant(self, node: ast.Constant) -> object:
        return node.value

    def _name(self, node: ast.Name) -> object:
        if node.id not in self.names:
            raise Unreadable(f"line {node.lineno}: {node.id}")
        return self.names[node.id]

    def _list(self, node: ast.List) -> list[object]:
        found: list[object] = []
        for each in node.elts:
            if isinstance(each, ast.Starred):
                found += self.of(each.value)
            else:
                found.append(self.of(each))
        return found

    def _tuple(self, node: ast.Tuple) -> tuple[object, ...]:
        return tuple(self.of(each) for each in node.elts)

    def _dict(self, node: ast.Dict) -> dict[object, object]:
        return {self.of(key): self.of(value) for key, value in zip(node.keys, node.values, strict=True) if key}

    def _joinedstr(self, node: ast.JoinedStr) -> str:
        return "".join(str(self.of(each)) for each in node.values)

    def _formattedvalue(self, node: ast.FormattedValue) -> object:
        return self.of(node.value)

    def _binop(self, node: ast.BinOp) -> object:
        left, right = self.of(node.left), self.of(node.right)
        if isinstance(node.op, ast.Add):
            return left + right
        if isinstance(node.op, ast.Mod) and isinstance(left, str):
            return left % right
        if isinstance(node.op, ast.Div):
            return Path(left) / right
        raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")

    def _listcomp(self, node: ast.ListComp) -> list[object]:
        if len(node.generators) != 1 or not isinstance(node.generators[0].target, ast.Name):
            raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")
        name, found = node.generators[0].target.id, list[Any]()
        for value in self.of(node.generators[0].iter):
            inner = Values(self._folder, {**self.names, name: value})
            if all(inner.of(each) for each in node.generators[0].ifs):
                found.append(inner.of(node.elt))
        return found

    _generatorexp = _listcomp

    def _unaryop(self, node: ast.UnaryOp) -> object:
        if isinstance(node.op, ast.Not):
            return not self.of(node.operand)
        if isinstance(node.op, ast.USub):
            return -self.of(node.operand)
        raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")

    def _boolop(self, node: ast.BoolOp) -> bool:
        together = all if isinstance(node.op, ast.And) else any
        return together(self.of(each) for each in node.values)

    def _compare(self, node: ast.Compare) -> bool:
        compare = COMPARED.get(type(node.ops[0])) if len(node.ops) == 1 else None
        if compare is None:
            raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")
        return compare(self.of(node.left), self.of(node.comparators[0]))

    def _subscript(self, node: ast.Subscript) -> object:
        if isinstance(node.slice, ast.Slice):
            ends = (self.of(each) if each else None for each in (node.slice.lower, node.slice.upper, node.slice.step))
            return self.of(node.value)[slice(*ends)]
        return self.of(node.value)[self.of(node.slice)]

    def _attribute(self, node: ast.Attribute) -> object:
        value = self.of(node.value)
        if isinstance(value, Path) and node.attr in ("name", "stem", "suffix", "parent"):
            return getattr(value, node.attr)
        raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")

    def _call(self, node: ast.Call) -> object:
        name = called_name(node)
        if name == "join" and isinstance(node.func, ast.Attribute) and ast.unparse(node.func).endswith("path.join"):
            return os.path.join(*(str(self.of(each)) for each in node.args))
        if name in ("glob", "iglob"):
            pattern = str(self.of(node.args[0]))
            recursive = any(each.arg == "recursive" for each in node.keywords)
            return sorted(glob.glob(pattern, root_dir=self._folder, recursive=recursive))
        if name in ("find_packages", "find_namespace_packages"):
            return self._packages(node)
        if name in PLAIN and isinstance(node.func, ast.Name) and len(node.args) == 1:
            return PLAIN[name](self.of(node.args[0]))
        if name in PATHS and isinstance(node.func, ast.Attribute) and ast.unparse(node.func).endswith(f"path.{name}"):
            return PATHS[name](self.of(node.args[0]))
        if name in OF_TEXTS and isinstance(node.func, ast.Attribute):
            text = self.of(node.func.value)
            if isinstance(text, str) and not (name == "format" and FORMATTED.search(text)):
                return getattr(text, name)(*(self.of(each) for each in node.args))
        raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")

    def _packages(self, node: ast.Call) -> list[str]:
        where = next((self.of(each.value) for each in node.keywords if each.arg == "where"), "")
        where = self.of(node.args[0]) if node.args else where
        base = self._folder / where
        return sorted(
            each.parent.name for each in base.glob("*/__init__.py") if each.parent.name not in ("test", "tests")
        )
