"""Modules loaded on the rclpy of PyPI import, while they load, only ROS packages that PyPI has.

An interface that only one function needs, such as that of composable nodes, is imported in the function: the console
attaches, and launch files run, without it. `.ci/on_rclpy` runs the contract suites there.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.session.machine.console_needs import BUNDLED_PACKAGE
from ros_names import OWN, ros_names

ROOT = Path(__file__).resolve().parents[2]
DISTROS = ("jazzy", "kilted")
FOLDERS = [ROOT / "tui", ROOT / "nodes", ROOT / "launch", *(ROOT / "runtime" / each for each in BUNDLED_PACKAGE)]
DEMOS = "nodes/demos/"
"""The nodes of the tutorials: they run with our runtime only."""
EXCEPTIONS = {
    "nodes/navigation_node.py": "serves actions of Nav2, which is installed where it runs",
    "nodes/simulation_ros/signals.py": "publishes transforms; exported to machines with an installed ROS 2",
    "runtime/ros2cli/verbs/component.py": "loaded by `ros2 component` only",
}
"""Modules that are not loaded on the rclpy of PyPI, with the reason."""


def packages_of_pypi(distro: str) -> set[str]:
    """The ROS packages that are installed from PyPI, and those that we provide there."""
    lines = (ROOT / ".ci" / "ros" / f"{distro}.txt").read_text(encoding="utf-8").splitlines()
    installed = {line.partition("==")[0] for line in lines if line.startswith("ros-")}
    return {each.removeprefix("ros-").replace("-", "_") for each in installed} | set(BUNDLED_PACKAGE)


LACKING = ros_names() - set.intersection(*map(packages_of_pypi, DISTROS)) - OWN


def imported_while_loading(tree: ast.AST) -> Iterator[str]:
    """Packages that a module imports before any of its functions is called, except where a failure is caught."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from (each.name.partition(".")[0] for each in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition(".")[0]
        elif isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            yield from (name for each in node.orelse for name in imported_while_loading(each))
        elif isinstance(node, ast.Try) and any("Error" in ast.unparse(each) for each in node.handlers):
            continue
        elif not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.expr)):
            yield from imported_while_loading(node)


def missing_packages(path: Path) -> set[str]:
    """The packages that a module imports while it loads although PyPI lacks them."""
    text = path.read_text(encoding="utf-8")
    named = {each for each in LACKING if each in text}  # most files need not be parsed
    return named & set(imported_while_loading(ast.parse(text))) if named else set()


def test_modules_import_at_once_only_what_pypi_has() -> None:
    paths = (path for folder in FOLDERS for path in sorted(folder.rglob("*.py")))
    found = {str(path.relative_to(ROOT)): names for path in paths if (names := missing_packages(path))}
    assert {path: names for path, names in found.items() if path not in EXCEPTIONS and not path.startswith(DEMOS)} == {}
    assert EXCEPTIONS.keys() <= found.keys(), "remove exceptions that are no longer needed"


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ("from composition_interfaces.srv import LoadNode", {"composition_interfaces"}),
        ("class Container:\n    import tf2_msgs.msg, std_msgs.msg", {"tf2_msgs"}),
        ("if sys.platform != 'win32':\n    from nav2_msgs.action import Spin", {"nav2_msgs"}),
        ("def load():\n    from composition_interfaces.srv import LoadNode", set()),
        ("if TYPE_CHECKING:\n    from nav2_msgs.action import Spin", set()),
        ("try:\n    import tf2_msgs\nexcept ImportError:\n    tf2_msgs = None", set()),
    ],
)
def test_only_imports_while_loading_count(source: str, found: set[str], tmp_path: Path) -> None:
    (tmp_path / "module.py").write_text(source)
    assert missing_packages(tmp_path / "module.py") == found
