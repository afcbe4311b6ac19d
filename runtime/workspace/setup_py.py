"""Reads the call of `setup()` in a `setup.py` without running the file.

Understood are the expressions that ROS packages write there: texts, names assigned above, `+`, `%`, f-strings,
`os.path.join`, `glob`, `find_packages`, lists, tuples, dicts and list comprehensions over them.
"""

from __future__ import annotations

import ast
import glob
import os
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

PANES = "bot_console.panes"
"""The group of entry points by which a package brings panes for the console."""

TARGET = re.compile(r"[\w.]+\s*(:\s*[\w.]+)?\s*(\[.*\])?")
"""What stands behind the `=` of an entry point: a module, its function, extras."""


@dataclass(frozen=True)
class SetupFile:
    """What a package installs: console scripts as `module:function`, files by target folder, Python packages."""

    console_scripts: dict[str, str] = field(default_factory=dict)
    scripts: dict[str, Path] = field(default_factory=dict)
    modules: dict[str, Path] = field(default_factory=dict)
    data_files: tuple[tuple[str, tuple[Path, ...]], ...] = ()
    panes: dict[str, str] = field(default_factory=dict)
    """Panes of the console that a package brings, as `module:class` (entry points of the group `bot_console.panes`)."""
    problem: str = ""
    """Why some of it is missing; empty when nothing is."""

    def merged(self, other: SetupFile) -> SetupFile:
        """Both together; what stands here wins."""
        return SetupFile(
            {**other.console_scripts, **self.console_scripts},
            {**other.scripts, **self.scripts},
            {**other.modules, **self.modules},
            self.data_files + other.data_files,
            {**other.panes, **self.panes},
            self.problem or other.problem,
        )


class Unreadable(ValueError):
    """An expression that only running the file could tell; the text says which and where."""


def read_setup_py(folder: Path) -> SetupFile:
    """Read `setup.py` of a package folder; raises `ValueError` with file and line when it is not Python."""
    path = folder / "setup.py"
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except SyntaxError as error:
        raise ValueError(f"{path}:{error.lineno}: {error.msg}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: {error}") from None
    names: dict[str, Any] = {"__file__": str(path)}
    reader = _Reader(folder, names)
    for statement in _statements(tree):
        reader.take(statement)
    return reader.result()


def _statements(tree: ast.Module) -> list[ast.stmt]:
    """Top-level statements, and those of a `main` or an `if __name__` block, in order."""
    found: list[ast.stmt] = []
    for statement in tree.body:
        if isinstance(statement, (ast.If, ast.FunctionDef)):
            found += statement.body
        else:
            found.append(statement)
    return found


class _Reader:
    """Walks the statements, remembers assigned names, and keeps what the setup() call says."""

    def __init__(self, folder: Path, names: dict[str, Any]) -> None:
        self._folder = folder
        self._path = folder / "setup.py"
        self._values = _Values(folder, names)
        self._keywords: dict[str, ast.expr] = {}

    def take(self, statement: ast.stmt) -> None:
        if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
            target = statement.targets[0]
            if isinstance(target, ast.Name):
                self._assign(target.id, statement.value)
        elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
            call = statement.value
            if _called(call) == "setup":
                self._keywords.update({each.arg: each.value for each in call.keywords if each.arg})
            elif _called(call) in ("append", "extend"):
                self._grow(call)

    def _assign(self, name: str, value: ast.expr) -> None:
        try:
            self._values.names[name] = self._values.of(value)
        except Unreadable:
            self._values.names.pop(name, None)

    def _grow(self, call: ast.Call) -> None:
        holder = call.func.value if isinstance(call.func, ast.Attribute) else None
        if isinstance(holder, ast.Name) and isinstance(self._values.names.get(holder.id), list):
            try:
                new = self._values.of(call.args[0])
            except (Unreadable, IndexError):
                return
            self._values.names[holder.id] += new if _called(call) == "extend" else [new]

    def _keyword(self, name: str, default: Any) -> Any:
        if name not in self._keywords:
            return default
        try:
            return self._values.of(self._keywords[name])
        except Unreadable:
            return default

    def result(self) -> SetupFile:
        entry_points, problem = self._entry_points()
        groups = entry_points if isinstance(entry_points, dict) else {}
        scripts = {Path(each).name: self._folder / each for each in self._keyword("scripts", [])}
        programs, panes = (entry_lines(groups.get(group, [])) for group in ("console_scripts", PANES))
        wrong = next((f"{name} = {target}" for name, target in programs.items() if not TARGET.fullmatch(target)), "")
        if wrong and not problem:
            problem = f"{self._path}: '{wrong}' is not of the form 'name = module:function'; a comma may be missing"
        programs = {name: target for name, target in programs.items() if TARGET.fullmatch(target)}
        return SetupFile(programs, scripts, self._modules(), self._data_files(), panes, problem)

    def _entry_points(self) -> tuple[Any, str]:
        """What stands there, or why it cannot be made out."""
        if "entry_points" not in self._keywords:
            return {}, ""
        try:
            return self._values.of(self._keywords["entry_points"]), ""
        except Unreadable as error:
            return {}, f"{self._path}: entry_points cannot be made out, {error}"

    def _modules(self) -> dict[str, Path]:
        places = {str(key): str(value) for key, value in self._keyword("package_dir", {}).items()}
        found: dict[str, Path] = {}
        for name in self._keyword("packages", []):
            if "." not in name:
                base = places.get(name) or str(Path(places.get("", "")) / name)
                found[name] = self._folder / base
        for name in self._keyword("py_modules", []):
            found[name] = self._folder / places.get("", "") / f"{name}.py"
        return {name: path for name, path in found.items() if path.exists()}

    def _data_files(self) -> tuple[tuple[str, tuple[Path, ...]], ...]:
        rows = self._keywords.get("data_files")
        if rows is None:
            return ()
        # Row by row, so that one row that cannot be read does not lose the others.
        elements = rows.elts if isinstance(rows, (ast.List, ast.Tuple)) else []
        values = [self._row(each) for each in elements] if elements else self._keyword("data_files", [])
        return tuple(
            (str(row[0]), tuple(self._folder / str(each) for each in row[1])) for row in values if row and len(row) == 2
        )

    def _row(self, row: ast.expr) -> Any:
        try:
            return self._values.of(row)
        except Unreadable:
            return None


def entry_lines(lines: Any) -> dict[str, str]:
    """Entry point lines `name = module:function` as a dict."""
    rows = lines.splitlines() if isinstance(lines, str) else lines
    pairs = (str(row).partition("=") for row in rows)
    return {name.strip(): target.strip() for name, sign, target in pairs if sign}


def _called(call: ast.Call) -> str:
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


class _Values:
    """Works out the value of an expression as far as that is possible without running code."""

    def __init__(self, folder: Path, names: dict[str, Any]) -> None:
        self.names = names
        self._folder = folder

    def of(self, node: ast.expr) -> Any:
        """The value; raises `Unreadable`."""
        method: Callable[[Any], Any] | None = getattr(self, f"_{type(node).__name__.lower()}", None)
        if method is None:
            raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")
        return method(node)

    def _constant(self, node: ast.Constant) -> Any:
        return node.value

    def _name(self, node: ast.Name) -> Any:
        if node.id not in self.names:
            raise Unreadable(f"line {node.lineno}: {node.id}")
        return self.names[node.id]

    def _list(self, node: ast.List) -> list[Any]:
        found: list[Any] = []
        for each in node.elts:
            if isinstance(each, ast.Starred):
                found += self.of(each.value)
            else:
                found.append(self.of(each))
        return found

    def _tuple(self, node: ast.Tuple) -> tuple[Any, ...]:
        return tuple(self.of(each) for each in node.elts)

    def _dict(self, node: ast.Dict) -> dict[Any, Any]:
        return {self.of(key): self.of(value) for key, value in zip(node.keys, node.values, strict=True) if key}

    def _joinedstr(self, node: ast.JoinedStr) -> str:
        return "".join(str(self.of(each)) for each in node.values)

    def _formattedvalue(self, node: ast.FormattedValue) -> Any:
        return self.of(node.value)

    def _binop(self, node: ast.BinOp) -> Any:
        left, right = self.of(node.left), self.of(node.right)
        if isinstance(node.op, ast.Add):
            return left + right
        if isinstance(node.op, ast.Mod) and isinstance(left, str):
            return left % right
        if isinstance(node.op, ast.Div):
            return Path(left) / right
        raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")

    def _listcomp(self, node: ast.ListComp) -> list[Any]:
        if len(node.generators) != 1 or not isinstance(node.generators[0].target, ast.Name):
            raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")
        name, found = node.generators[0].target.id, list[Any]()
        for value in self.of(node.generators[0].iter):
            found.append(_Values(self._folder, {**self.names, name: value}).of(node.elt))
        return found

    def _call(self, node: ast.Call) -> Any:
        name = _called(node)
        if name == "join" and isinstance(node.func, ast.Attribute) and ast.unparse(node.func).endswith("path.join"):
            return os.path.join(*(str(self.of(each)) for each in node.args))
        if name in ("glob", "iglob"):
            pattern = str(self.of(node.args[0]))
            recursive = any(each.arg == "recursive" for each in node.keywords)
            return sorted(glob.glob(pattern, root_dir=self._folder, recursive=recursive))
        if name in ("find_packages", "find_namespace_packages"):
            return self._packages(node)
        if name in ("str", "list", "sorted") and len(node.args) == 1:
            return {"str": str, "list": list, "sorted": sorted}[name](self.of(node.args[0]))
        raise Unreadable(f"line {node.lineno}: {ast.unparse(node)}")

    def _packages(self, node: ast.Call) -> list[str]:
        where = next((self.of(each.value) for each in node.keywords if each.arg == "where"), "")
        where = self.of(node.args[0]) if node.args else where
        base = self._folder / where
        return sorted(
            each.parent.name for each in base.glob("*/__init__.py") if each.parent.name not in ("test", "tests")
        )
