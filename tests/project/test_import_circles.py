"""There are no circular imports, not even through late imports or imports for annotations."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from bot_console.runtime.importer import PACKAGES
from syntax import statements

ROOT = Path(__file__).parents[2]
GENERATED = ROOT / "runtime" / "rosidl" / "generated"
ALLOWED: dict[frozenset[str], str] = {}
"""The allowed circles, as sets of modules, each with the reason. There are none."""
BELOW_ALL = ("rclpy._rclpy_pybind11", "rclpy.constants")
"""The stand-in for upstream's C extension, and plain numbers: both are below everything else of rclpy."""
Graph = dict[str, set[str]]


def modules() -> dict[str, Path]:
    """All our modules by canonical name; a ROS package's is the name under which it is imported."""
    found: dict[str, Path] = {}
    for top in ("runtime", "tui", "nodes"):
        for path in (ROOT / top).rglob("*.py"):
            if GENERATED in path.parents:
                continue
            parts = path.relative_to(ROOT).with_suffix("").parts
            found[canonical("bot_console." + ".".join(parts).removesuffix(".__init__"))] = path
    return found


def canonical(name: str) -> str:
    """The canonical name of a module that has two."""
    inside = name.removeprefix("bot_console.runtime.")
    if inside != name and inside.partition(".")[0] in PACKAGES:
        return inside
    return name.replace("bot_console_robot", "bot_console.nodes", 1) if name.startswith("bot_console_robot") else name


def names(path: Path, package: str) -> Iterator[tuple[str, str | None]]:
    """The imports of a module: at the top, late within functions, or under `if TYPE_CHECKING`."""
    for node in statements(path):
        if isinstance(node, ast.Import):
            yield from ((each.name, None) for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            yield from ((base, each.name) for each in node.names)


def imported(name: str, path: Path, known: dict[str, Path]) -> Iterator[str]:
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for base, attribute in names(path, package):
        module = canonical(base)
        inner = f"{module}.{attribute}"
        target = inner if attribute and inner in known else module
        if target in known and target != name:
            yield target


@cache
def graph() -> Graph:
    known = modules()
    return {name: set(imported(name, path, known)) for name, path in known.items()}


def circles(edges: Graph) -> list[frozenset[str]]:
    """The strongly connected components of more than one module (Tarjan)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[frozenset[str]] = []

    def visit(start: str) -> None:
        work = [(start, iter(sorted(edges[start])))]
        index[start] = low[start] = len(index)
        stack.append(start)
        while work:
            name, rest = work[-1]
            for target in rest:
                if target not in index:
                    index[target] = low[target] = len(index)
                    stack.append(target)
                    work.append((target, iter(sorted(edges[target]))))
                    break
                if target in stack:
                    low[name] = min(low[name], index[target])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[name])
                if low[name] == index[name]:
                    at = stack.index(name)
                    members = frozenset(stack[at:])
                    del stack[at:]
                    if len(members) > 1:
                        found.append(members)

    for name in sorted(edges):
        if name not in index:
            visit(name)
    return found


def test_no_circular_imports():
    left = [sorted(each) for each in circles(graph()) if each not in ALLOWED]
    assert not left, "\n".join(" <-> ".join(each) for each in left)


def test_allowed_circles_exist():
    assert set(ALLOWED) <= set(circles(graph()))


def test_modules_below_public_rclpy_import_none_of_it():
    up = {
        (name, target)
        for name, targets in graph().items()
        if name.startswith("rclpy.impl.")
        for target in targets
        if target.startswith("rclpy") and not target.startswith("rclpy.impl") and target not in BELOW_ALL
    }
    assert not up


def test_parts_of_a_node_do_not_import_the_node():
    up = {name for name, targets in graph().items() if name.startswith("rclpy.node_parts.") and "rclpy.node" in targets}
    assert not up


@pytest.mark.parametrize("back", ["from . import a", "if TYPE_CHECKING:\n    from x import a", "import json"])
def test_late_imports_and_annotations_count(tmp_path, back):
    late, other = tmp_path / "a.py", tmp_path / "b.py"
    late.write_text("def f():\n    from x import b\n")
    other.write_text(f"{back}\n")
    known = {"x.a": late, "x.b": other}
    edges = {name: set(imported(name, path, known)) for name, path in known.items()}
    assert circles(edges) == ([] if back == "import json" else [frozenset(known)])
