"""Checks the parameters that a Python launch file gives to nodes of its own package, without running it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

from bot_console.runtime.programs.hints import RETURN_DESCRIPTION
from bot_console.tui.cli.lint.finding import LintFinding

MANIFEST = "package.xml"
FUNCTION = "generate_launch_description"


def dead_parameters(path: Path, declared: frozenset[str]) -> Iterator[LintFinding]:
    """The names in a literal `parameters=[{...}]` of `Node(...)` that no node of its package declares.

    Nodes of other packages are skipped, since their parameters are unknown. Raises `SyntaxError` for invalid Python.
    """
    package = _package_of(path)
    for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))) if package else ():
        if not isinstance(call, ast.Call):
            continue
        given = {each.arg: each.value for each in call.keywords}
        whose = given.get("package")
        if isinstance(whose, ast.Constant) and whose.value == package:
            for name, line in _names(given):
                if name not in declared and name != "use_sim_time" and not name.startswith("qos_overrides."):
                    yield LintFinding(str(path), line, "dead parameter", name)


def missing_return(path: Path) -> Iterator[LintFinding]:
    """A finding if the function of a launch file returns nothing; raises `SyntaxError` for invalid Python."""
    for each in ast.parse(path.read_text(encoding="utf-8"), str(path)).body:
        if isinstance(each, ast.FunctionDef) and each.name == FUNCTION and not any(_returned(each)):
            yield LintFinding(str(path), each.lineno, "returns nothing", f"{FUNCTION}()", RETURN_DESCRIPTION)


def _returned(node: ast.AST) -> Iterator[bool]:
    """Whether each return has a value; those of functions inside are skipped."""
    for each in ast.iter_child_nodes(node):
        if isinstance(each, ast.Return):
            yield each.value is not None
        elif not isinstance(each, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)):
            yield from _returned(each)


def folder_of_package(path: Path) -> Path | None:
    """The folder of the package that contains a file, with its `package.xml`; None if none does."""
    return next((each for each in path.resolve().parents if (each / MANIFEST).is_file()), None)


def package_name(folder: Path) -> str:
    """The name in the `package.xml` of a folder; empty if it cannot be read."""
    try:
        name = ElementTree.parse(folder / MANIFEST).getroot().findtext("name")
    except (ElementTree.ParseError, OSError):
        return ""
    return (name or "").strip()


def _package_of(path: Path) -> str:
    """The name of the package that contains a file; empty if none does."""
    folder = folder_of_package(path)
    return package_name(folder) if folder else ""


def _names(given: Mapping[str | None, ast.expr]) -> Iterator[tuple[str, int]]:
    parameters = given.get("parameters")
    for each in parameters.elts if isinstance(parameters, ast.List) else ():
        if isinstance(each, ast.Dict):
            yield from _flat(each, "")


def _flat(found: ast.Dict, above: str) -> Iterator[tuple[str, int]]:
    """The parameter names, prefixed with the groups in which they are nested, each with its line."""
    for key, value in zip(found.keys, found.values, strict=True):
        if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
            continue
        if isinstance(value, ast.Dict):
            yield from _flat(value, f"{above}{key.value}.")
        else:
            yield f"{above}{key.value}", key.lineno
