"""Declared packages are imported, imported packages are declared, and the documentation gives a reason for each."""

import ast
import re
import sys
from functools import cache
from pathlib import Path

import pytest
from ros_names import ros_names
from syntax import statements

if sys.version_info >= (3, 11):
    import tomllib
else:
    tomllib = pytest.importorskip("tomli")

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("tui", "runtime", "nodes", "launch")
IMPORT_NAMES = {
    "opencv-python-headless": "cv2",
    "pyyaml": "yaml",
    "eclipse-zenoh": "zenoh",
    "google-re2": "re2",
    "pillow": "PIL",
    "textual-serve": "textual_serve",
}
BUILD_ONLY = {"rosbags"}
"""Imported only at build time (`runtime/rosidl/standard.py`)."""


def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def import_names(requirements):
    distributions = {re.match(r"[A-Za-z0-9_.-]+", each)[0].lower() for each in requirements}
    return {IMPORT_NAMES.get(each, each) for each in distributions}


@cache
def imported():
    """Top-level names that any file imports, including late and optional imports."""
    names = set()
    for path in (path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")):
        if "generated" in path.parts:
            continue
        for node in statements(path):
            if isinstance(node, ast.Import):
                names |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                names.add(node.module.split(".")[0])
        names |= by_name(path.read_text(encoding="utf-8"))
    return names


def by_name(text):
    """Top-level names that a source imports with `import_module`."""
    if "import_module" not in text:
        return set()
    calls = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)]
    named = (node.args[0] for node in calls if called_name(node.func) == "import_module" and node.args)
    return {str(each.value).split(".")[0] for each in named if isinstance(each, ast.Constant)}


def called_name(function):
    """The last part of a called function's name."""
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


@pytest.mark.slow
def test_declared_dependencies_are_imported():
    assert import_names(project()["dependencies"]) - imported() == set()


def test_imported_packages_are_declared():
    extras = project()["optional-dependencies"]
    optional = [line for name, lines in extras.items() if name != "dev" for line in lines]
    known = (
        import_names([*project()["dependencies"], *optional]) | BUILD_ONLY | ros_names() | set(sys.stdlib_module_names)
    )
    assert imported() - known == set()


def test_each_dependency_has_its_reason():
    page = (ROOT / "docs" / "dependencies.md").read_text(encoding="utf-8")
    missing = [name for name in sorted(import_names(project()["dependencies"])) if f"| `{name}` |" not in page]
    assert missing == []


def test_all_allowed_textual_versions_are_known_to_the_terminal_code():
    bounds = next(each for each in project()["dependencies"] if each.startswith("textual"))
    gate = re.search(r'startswith\("(\d+)\.(\d+)\."\)', (ROOT / "tui" / "terminal" / "output.py").read_text())
    major, minor = map(int, gate.groups())
    assert re.fullmatch(rf"textual>={major}\.{minor}(\.\d+)?,<{major}\.{minor + 1}", bounds)


@pytest.mark.parametrize("distro", ["jazzy", "kilted"])
def test_wheels_of_ros_have_the_versions_that_are_tested(distro):
    tested = (ROOT / ".ci" / "ros" / f"{distro}.txt").read_text(encoding="utf-8").splitlines()
    for line in project()["optional-dependencies"][f"ros-{distro}"]:
        requirement, _, marker = line.partition("; ")
        assert re.sub(r"\[\w+\]", "", requirement) in tested
        assert marker == "sys_platform == 'linux' and platform_machine == 'x86_64'"
