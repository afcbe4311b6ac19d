"""Checks that the packages named by a launch file exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from bot_console.runtime.importer import install
from bot_console.runtime.programs.hints import did_you_mean
from bot_console.runtime.workspace.available_names import package_names
from bot_console.runtime.workspace.executables import executables
from bot_console.tui.cli.lint.finding import LintFinding
from bot_console.tui.cli.lint.launch_file import MANIFEST, folder_of_package, package_name

PACKAGE_LOOKUPS = frozenset((
    "FindPackageShare", "FindPackagePrefix", "get_package_share_directory", "get_package_share_path",
    "get_package_prefix",
))  # fmt: skip
"""Functions and substitutions whose first argument is the name of a package."""
NODES = frozenset({"Node", "LifecycleNode", "ComposableNode", "ComposableNodeContainer"})


def unknown_packages(path: Path) -> Iterator[LintFinding]:
    """A finding for each package that is neither in the workspace nor installed; raises `SyntaxError`, `OSError`."""
    named = _in_python(path) if path.suffix == ".py" else _in_xml(path)
    neighbours = _neighbours(path)
    for name, line in dict.fromkeys(named):
        if name not in neighbours and not _exists(name):
            yield LintFinding(str(path), line, "no such package", name, known=_hint(name))


def _neighbours(path: Path) -> set[str]:
    """The names of the package that contains a file and of those beside it, which may be outside the workspace."""
    folder = folder_of_package(path)
    if folder is None:
        return set()
    return {package_name(each.parent) for each in (folder / MANIFEST, *folder.parent.glob(f"*/{MANIFEST}"))}


def _in_python(path: Path) -> Iterator[tuple[str, int]]:
    for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
        if not isinstance(call, ast.Call):
            continue
        called = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        given = {each.arg: each.value for each in call.keywords}
        name = given.get("package") if called in NODES or called in PACKAGE_LOOKUPS else None
        if called in PACKAGE_LOOKUPS:
            name = name or given.get("package_name") or (call.args[0] if call.args else None)
        if isinstance(name, ast.Constant) and isinstance(name.value, str):
            yield name.value, name.lineno


def _in_xml(path: Path) -> Iterator[tuple[str, int]]:
    text = path.read_text(encoding="utf-8")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError:
        return
    for each in root.iter():
        name = each.get("pkg", "")
        if name and "$" not in name:
            line = next((at for at, written in enumerate(text.splitlines(), 1) if f'"{name}"' in written), 0)
            yield name, line


def _exists(package: str) -> bool:
    install()
    from ament_index_python.packages import get_package_prefix
    from bot_console.runtime.launch_ros.node_program import container_path

    for look in (get_package_prefix, executables):
        try:
            look(package)
        except (LookupError, ValueError):
            continue
        return True
    return container_path(package, "component_container") is not None


def _hint(package: str) -> str:
    meant = did_you_mean(package, package_names(), "'").strip(" ;:,.")
    return meant or "add it to the workspace; the file cannot be launched here without it"
