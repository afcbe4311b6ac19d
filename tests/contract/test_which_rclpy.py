"""With PyPI's rclpy in the environment of a set-up shell: which program uses which rclpy, and what `doctor` reports."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.cli.verbs import setup
from domains import unused_domain
from rigs import is_embedded_rclpy

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(300),
    pytest.mark.skipif(is_embedded_rclpy(), reason="needs an environment with the rclpy of PyPI: .ci/on_rclpy"),
]
TALKER = """
import rclpy
rclpy.init()
node = rclpy.create_node("of_the_real_rclpy")
print(rclpy.__file__, flush=True)
rclpy.spin(node)
"""
SHOW = "import rclpy; print(rclpy.__file__)"
TIMEOUT_S = 240.0


@pytest.fixture(scope="module")
def shell(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of a shell that has evaluated `bot-console setup`; its `python3` has a real rclpy."""
    home = tmp_path_factory.mktemp("home")
    path = os.pathsep.join([str(Path(sys.executable).parent), os.defpath])
    env = {"PATH": path, "HOME": str(home), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    env["ROS_DOMAIN_ID"] = str(unused_domain())
    done = subprocess.run(
        ["bash", "--norc", "-c", f"{setup.evaluation('bash')}\nenv -0"],
        env=env, stdout=subprocess.PIPE, text=True, check=True, timeout=TIMEOUT_S,
    )  # fmt: skip
    found = dict(each.split("=", 1) for each in done.stdout.split("\0") if "=" in each)
    assert "shims" in found["PYTHONPATH"]
    return found


@pytest.fixture(scope="module")
def talker(shell: dict[str, str]) -> Iterator[str]:
    """A node run by plain `python3`; yields the file from which its rclpy comes."""
    line = ["python3", "-c", TALKER]
    with subprocess.Popen(line, env=shell, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield process.stdout.readline().strip()
        process.kill()


def output(shell: dict[str, str], *line: str) -> str:
    done = subprocess.run(
        [str(Path(sys.executable).with_name(line[0])), *line[1:]],
        env=shell, capture_output=True, text=True, check=False, timeout=TIMEOUT_S,
    )  # fmt: skip
    return done.stdout


def test_python_uses_the_real_rclpy_and_run_uses_the_embedded_one(shell: dict[str, str], talker: str) -> None:
    assert Path(talker).is_relative_to(sys.prefix) and "bot_console" not in talker
    assert Path(output(shell, "bot-console", "run", "-c", SHOW).strip()).match("runtime/rclpy/__init__.py")


def test_doctor_reports_who_uses_which(shell: dict[str, str], talker: str) -> None:
    findings = {each["about"]: each["text"] for each in json.loads(output(shell, "bot-console", "doctor", "--json"))}
    folder = os.path.dirname(talker)
    assert f"imports the real rclpy ({folder}); `bot-console run` the embedded one" in findings["rclpy"]
    assert f"({folder}): `bot-console attach --ros`" in findings["ros"]


def test_console_attached_to_the_machine_shows_nodes_of_the_real_rclpy(shell: dict[str, str], talker: str) -> None:
    """`doctor --ros` sees what `attach --ros` shows: both import the rclpy of the machine."""
    findings = {
        each["about"]: each["text"] for each in json.loads(output(shell, "bot-console", "doctor", "--ros", "--json"))
    }
    assert re.fullmatch("[0-9]+ other nodes?", findings["graph"])
    alone = output(
        shell, "bot-console", "run", "-c", "import rclpy; rclpy.init(); print(rclpy.create_node('n').get_node_names())"
    )
    assert alone == "['n']\n"
