"""What the fork server imports for a program before it forks: NumPy for programs that may need it, nothing else."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

from bot_console.runtime.children import import_prefetch
from bot_console.runtime.children.own_fork_server import PREPARE
from bot_console.runtime.process.fork_server import ForkServer, Job

PLAIN = "bot_console.runtime.importer:install"
ENDS = "import sys\nprint(sorted(each for each in ('numpy', 'tf2_ros') if each in sys.modules))\nraise SystemExit\n"


def imported(folder: Path, function: str, arguments: list[object]) -> str:
    """Return the modules that a process has imported when its first line runs."""
    server = ForkServer(PLAIN, PREPARE)
    taken, given = os.pipe()
    null = os.open(os.devnull, os.O_RDWR)
    try:
        words = ([], f"bot_console.runtime.workspace.launched:{function}", arguments)
        job = Job("x", "bot_console.runtime.children.own_fork_server:begun", words, ["x"], {}, str(folder))
        os.close(server.start(job, stdin=null, stdout=given, stderr=2, data=null))
        os.close(given)
        with os.fdopen(taken) as output:
            return output.read().strip()
    finally:
        os.close(null)
        server.close()


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("import rclpy, json\nfrom rclpy.node import Node\nfrom std_msgs.msg import String, Header", []),
        pytest.param(
            "from sensor_msgs.msg import LaserScan\nfrom geometry_msgs.msg import Twist", [], marks=pytest.mark.slow
        ),
        pytest.param("from std_srvs.srv import Trigger", [], marks=pytest.mark.slow),
        ("import math\nimport numpy as np", ["numpy"]),
        pytest.param("def f():\n    import cv2", ["numpy"], marks=pytest.mark.slow),
        pytest.param("from nav_msgs.msg import Odometry", ["numpy"], marks=pytest.mark.slow),
        pytest.param("from nav_msgs import msg", ["numpy"], marks=pytest.mark.slow),
        pytest.param("import helpers", ["numpy"], marks=pytest.mark.slow),
        pytest.param("from . import helpers", ["numpy"], marks=pytest.mark.slow),
        pytest.param("from std_msgs.msg import Unknown", ["numpy"], marks=pytest.mark.slow),
        pytest.param("from rclpy.action import ActionClient", ["numpy"], marks=pytest.mark.slow),
        pytest.param("import tf2_ros", ["tf2_ros"], marks=pytest.mark.slow),
        pytest.param("from rclpy.nowhere import nothing\nimport numpy", ["numpy"], marks=pytest.mark.slow),
        ("import numpy\n1 +", []),
    ],
)
def test_numpy_is_imported_for_a_file_that_may_need_it(text: str, wanted: list[str], tmp_path: Path) -> None:
    file = tmp_path / "node.py"
    if text.endswith("+"):
        file.write_text(text)
        assert imported(tmp_path, "python_file", [[], str(file), [], False]) == ""
        return
    file.write_text(ENDS + text)
    assert imported(tmp_path, "python_file", [[], str(file), [], False]) == str(wanted)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("import json\nfrom std_srvs.srv import Trigger", []),
        ("def f():\n    import cv2", ["numpy"]),
        ("from nav_msgs import msg", ["numpy"]),
        ("from . import helpers", ["numpy"]),
        ("from std_msgs.msg import Unknown", ["numpy"]),
        ("from rclpy.action import ActionClient", ["numpy", "rclpy.action"]),
        ("from rclpy.nowhere import nothing\nimport numpy", ["rclpy.nowhere", "numpy"]),
    ],
)
def test_needed_modules_are_read_from_the_imports_of_a_file(text: str, wanted: list[str], tmp_path: Path) -> None:
    (tmp_path / "node.py").write_text(text)
    assert [*import_prefetch._modules_needed(str(tmp_path / "node.py"))] == wanted


def test_numpy_is_imported_for_an_entry_point_that_needs_it(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "b.py").write_text("import json\n\n\ndef main():\n    " + ENDS.replace("\n", "\n    "))
    assert imported(tmp_path, "entry_point", [[], "a.b:main", [str(tmp_path)]]) == "[]"
    (tmp_path / "a" / "c.py").write_text((tmp_path / "a" / "b.py").read_text() + "\nimport numpy.linalg")
    assert imported(tmp_path, "entry_point", [[], "a.c:main", [str(tmp_path)]]) == "['numpy']"
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    assert imported(elsewhere, "entry_point", [[], "json.tool:main", [str(tmp_path)]]) == ""


def test_numpy_that_fails_to_import_does_not_end_the_server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "numpy.py").write_text("raise ImportError('broken')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    server = ForkServer(PLAIN, PREPARE)
    null = os.open(os.devnull, os.O_RDWR)
    words = ([], "bot_console.runtime.workspace.launched:entry_point", [[], "json.tool:main", []])
    job = Job("x", "bot_console.runtime.children.own_fork_server:begun", words, ["x"], {}, str(tmp_path))
    with os.fdopen(server.start(job, stdin=null, stdout=null, stderr=null, data=null), "rb") as report:
        os.close(null)
        assert report.read().startswith(b"pid ")
    server.close()
