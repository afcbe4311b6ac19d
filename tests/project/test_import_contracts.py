"""The import contracts hold, and a planted violation is noticed."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.slow

PLANTED = {
    "tui/console/model/snapshot.py": "import rclpy",
    "tui/panes/logs/pane.py": "import bot_console.runtime.importer",
    "tui/console/node.py": "import bot_console.runtime.importer",
    "tui/session/protocol.py": "import rclpy",
    "tui/session/live.py": "import bot_console.runtime.importer",
    "tui/session/launch_host/host.py": "import bot_console.runtime.importer",
    "tui/session/embedded/domain.py": "import bot_console.tui.app",
    "runtime/programs/run.py": "import bot_console.tui.format",
    "runtime/process/current.py": "import bot_console.runtime.rmw.bus",
    "runtime/rmw/local.py": "import rclpy",
    "nodes/robot_node.py": "import bot_console.runtime.importer",
}


@pytest.fixture(scope="module")
def house(tmp_path_factory):
    """A copy of the sources, with the file of contracts."""
    place = tmp_path_factory.mktemp("house")
    package = place / "build" / "editable" / "bot_console"
    for each in ("tui", "runtime", "nodes"):
        shutil.copytree(ROOT / each, package / each, ignore=shutil.ignore_patterns("__pycache__", "generated"))
    shutil.copy(ROOT / "pyproject.toml", place)
    return place


def check(house):
    program = "import sys; from importlinter.cli import lint_imports_command; lint_imports_command()"
    words = [sys.executable, "-c", program, "--no-cache"]
    environment = {**os.environ, "PYTHONPATH": str(house / "build" / "editable")}
    return subprocess.run(words, cwd=house, env=environment, capture_output=True, text=True, check=False)


def test_import_contracts_hold(house):
    done = check(house)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def violation_messages(house):
    """The messages about all planted violations at once."""
    for path, line in PLANTED.items():
        place = house / "build" / "editable" / "bot_console" / path
        place.write_text(f"{place.read_text(encoding='utf-8')}\n{line}\n", encoding="utf-8")
    done = check(house)
    assert done.returncode == 1, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("path", PLANTED)
def test_planted_violation_is_reported(violation_messages, path):
    module = "bot_console." + path.removesuffix(".py").replace("/", ".")
    assert re.search(rf"{re.escape(module)} -> {PLANTED[path].removeprefix('import ')}\b", violation_messages), (
        violation_messages
    )
