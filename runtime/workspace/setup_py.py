"""Reads the call of `setup()` in a `setup.py` without running the file.

It understands the expressions that ROS packages commonly use: strings and their methods, names assigned above, `+`,
`%`, f-strings, `os.path`, `glob`, `find_packages`, lists, tuples, dicts, and comprehensions over them.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple, cast

from bot_console.runtime.workspace.setup_py_syntax import first_mistake
from bot_console.runtime.workspace.setup_values import Unreadable, Values, called_name

PANES = "bot_console.panes"
"""The entry point group through which a package provides panes for the console."""

WRITTEN_OUT = "Write them out: 'name = package.module:main'"
TARGET = re.compile(r"[\w.]+\s*(:\s*[\w.]+)?\s*(\[.*\])?")
"""The part of an entry point after the `=`: a module, a function and extras."""


class DataRow(NamedTuple):
    """A row of `data_files`: its line, target folder and files, and the call of `glob` that finds them, if any."""

    line: int
    target: str
    files: tuple[Path, ...]
    written: str = ""


@dataclass(frozen=True)
class SetupFile:
    """The contents that a package installs: scripts as `module:function`, files by target folder, Python packages."""

    console_scripts: dict[str, str] = field(default_factory=dict[str, str])
    scripts: dict[str, Path] = field(default_factory=dict[str, Path])
    modules: dict[str, Path] = field(default_factory=dict[str, Path])
    data_files: tuple[tuple[str, tuple[Path, ...]], ...] = ()
    panes: dict[str, str] = field(default_factory=dict[str, str])
    """The panes that a package provides for the console, as `module:class` (entry points of the group
    `bot_console.panes`).
    """
    problem: str = ""
    """Why part of the contents is missing; empty if none is."""
    name: str = ""
    packages: tuple[str, ...] | None = None
    """The Python packages as listed; None if the list cannot be evaluated."""
    rows: tuple[DataRow, ...] = ()
    has_all_rows: bool = True
    """Whether `rows` covers all of `data_files`; False if a part of it cannot be evaluated."""
    lines: Mapping[str, int] = field(default_factory=dict[str, int])
    """The lines of the arguments of `setup()`, by their names."""

    def merged(self, other: SetupFile) -> SetupFile:
        """Return the two combined; values of this one take precedence."""
        return SetupFile(
            {**other.console_scripts, **self.console_scripts},
            {**other.scripts, **self.scripts},
            {**other.modules, **self.modules},
            self.data_files + other.data_files,
            {**other.panes, **self.panes},
            self.problem or other.problem,
            self.name or other.name,
            self.packages if self.packages is not None else other.packages,
            self.rows + other.rows,
            self.has_all_rows and other.has_all_rows,
            {**other.lines, **self.lines},
        )


def read_setup_py(folder: Path) -> SetupFile:
    """Read the `setup.py` of a package folder; raises `ValueError` with file and line if it is not Python."""
    path = folder / "setup.py"
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except SyntaxError as error:
        raise ValueError(f"{path}:{error.lineno}: {error.msg}") from None
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: {error}") from None
    except (MemoryError, RecursionError):
        raise ValueError(f"{path}: its expressions are nested too deeply") from None
    names: dict[str, Any] = {"__file__": str(path)}
    reader = _Reader(folder, names)
    for statement in _statements(tree):
        reader.take(statement)
    read = reader.result()
    mistake = "" if read.problem else first_mistake(tree)
    return replace(read, problem=f"{path}: {mistake}") if mistake else read


def _statements(tree: ast.Module) -> list[ast.stmt]:
    """Return the top-level statements, and those in `main` or an `if __name__` block, in order."""
    found: list[ast.stmt] = []
    for statement in tree.body:
        if isinstance(statement, (ast.If, ast.FunctionDef)):
            found += statement.body
        else:
            found.append(statement)
    return found


class _Reader:
    """Walks the statements, remembers assigned names, and records the arguments of the setup() call."""

    def __init__(self, folder: Path, names: dict[str, Any]) -> None:
        self._folder = folder
        self._path = folder / "setup.py"
        self._values = Values(folder, names)
        self._keywords: dict[str, ast.expr] = {}
        self._has_all_rows = True

    def take(self, statement: ast.stmt) -> None:
        if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
            target = statement.targets[0]
            if isinstance(target, ast.Name):
                self._assign(target.id, statement.value)
        elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
            call = statement.value
            if called_name(call) == "setup":
                self._keywords.update({each.arg: each.value for each in call.keywords if each.arg})
                self._has_all_rows = all(each.arg for each in call.keywords)
            elif called_name(call) in ("append", "extend"):
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
            self._values.names[holder.id] += new if called_name(call) == "extend" else [new]

    def _keyword(self, name: str, default: object) -> Any:
        if name not in self._keywords:
            return default
        try:
            return self._values.of(self._keywords[name])
        except Unreadable:
            return default

    def result(self) -> SetupFile:
        entry_points, problem = self._entry_points()
        groups = cast("dict[str, Any]", entry_points) if isinstance(entry_points, dict) else {}
        scripts = {Path(each).name: self._folder / each for each in self._keyword("scripts", [])}
        programs, panes = (entry_lines(groups.get(group, [])) for group in ("console_scripts", PANES))
        wrong = next((f"{name} = {target}" for name, target in programs.items() if not TARGET.fullmatch(target)), "")
        if wrong and not problem:
            problem = f"{self._path}: '{wrong}' is not of the form 'name = module:function'; a comma may be missing"
        programs = {name: target for name, target in programs.items() if TARGET.fullmatch(target)}
        listed = self._keyword("packages", None)
        rows = self._rows()
        return SetupFile(
            programs,
            scripts,
            self._modules(),
            tuple((row.target, row.files) for row in rows),
            panes,
            problem,
            str(self._keyword("name", "")),
            tuple(map(str, cast("Sequence[object]", listed))) if isinstance(listed, (list, tuple)) else None,
            rows,
            self._has_all_rows,
            {name: value.lineno for name, value in self._keywords.items()},
        )

    def _entry_points(self) -> tuple[Any, str]:
        """Return the entry points, and why they cannot be evaluated."""
        if "entry_points" not in self._keywords:
            return {}, ""
        try:
            return self._values.of(self._keywords["entry_points"]), ""
        except Unreadable as error:
            return {}, f"{self._path}: entry_points cannot be evaluated, {error}. {WRITTEN_OUT}"

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

    def _rows(self) -> tuple[DataRow, ...]:
        rows = self._keywords.get("data_files")
        if rows is None:
            return ()
        # Row by row, so that a row that cannot be evaluated does not lose the others.
        elements = rows.elts if isinstance(rows, (ast.List, ast.Tuple)) else []
        found = [(each.lineno, self._row(each), _written_glob(each)) for each in elements]
        if not isinstance(rows, (ast.List, ast.Tuple)) or not all(row for _, row, _ in found):
            self._has_all_rows = False
        if not elements:
            found = [(rows.lineno, row, "") for row in self._keyword("data_files", [])]
        return tuple(
            DataRow(line, str(row[0]), tuple(self._folder / str(each) for each in row[1]), written)
            for line, row, written in found
            if row and len(row) == 2
        )

    def _row(self, row: ast.expr) -> Any:
        try:
            return self._values.of(row)
        except Unreadable:
            return None


def _written_glob(row: ast.expr) -> str:
    """Return the call of `glob` in a row, as it is written."""
    calls = (each for each in ast.walk(row) if isinstance(each, ast.Call) and called_name(each) in ("glob", "iglob"))
    return next((ast.unparse(each) for each in calls), "")


def entry_lines(lines: Any) -> dict[str, str]:
    """Return entry point lines `name = module:function` as a dict."""
    rows = lines.splitlines() if isinstance(lines, str) else lines
    pairs = (str(row).partition("=") for row in rows)
    return {name.strip(): target.strip() for name, sign, target in pairs if sign}
