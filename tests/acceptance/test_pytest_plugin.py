"""A user's tests under plain pytest: isolated in their domain, in real or stepped time."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from helpers.shells import in_shell, make_home, set_up

if os.name != "posix":
    pytest.skip("needs a shell", allow_module_level=True)

PLUGIN = ("-p", "bot_console_pytest")
DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "testing.md"
MEETS = """
import os, time
from pathlib import Path
import rclpy

def test_it_meets_nobody():
    rclpy.init()
    node = rclpy.create_node(f"of_{os.getpid()}")
    place = Path(os.environ["PLACE"])
    (place / str(os.getpid())).touch()
    while len(list(place.iterdir())) < 2:  # both have joined
        rclpy.spin_once(node, timeout_sec=0.05)
    assert [each for each in node.get_node_names() if each.startswith("of_")] == [node.get_name()]
    node.destroy_node()
    rclpy.shutdown()
"""
TIMES = """
import os, subprocess, sys, threading, time
import pytest, rclpy
from std_msgs.msg import String

CHILD = '''
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("child")
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_publisher(String, "t", latched).publish(String(data="x"))
rclpy.spin(node)
'''

@pytest.fixture
def node():
    rclpy.init()
    node = rclpy.create_node("tested")
    yield node
    node.destroy_node()
    rclpy.try_shutdown()

@pytest.mark.ros_time("stepped")
def test_an_hour_passes_at_once(node):
    later = rclpy.task.Future()
    node.create_timer(3600.0, lambda: later.set_result(True))
    rclpy.spin_until_future_complete(node, later, timeout_sec=4000.0)
    assert later.done()

def test_clock_lets_time_pass(stepped_time, node):
    ticks = []
    node.create_timer(1.0, lambda: ticks.append(time.monotonic()))
    thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    thread.start()
    stepped_time.run_for(1000.5)
    assert len(ticks) == 1000
    rclpy.shutdown()
    thread.join()

def test_child_is_heard(ros_domain, node):
    assert os.environ["BOT_CONSOLE_SOCKET_DIR"] != os.environ["OUTSIDE"], "where other programs meet"
    heard = []
    node.create_subscription(String, "t", heard.append, rclpy.qos.QoSProfile(depth=1, durability=1))
    child = subprocess.Popen([sys.executable, "-c", CHILD])
    while not heard:
        rclpy.spin_once(node, timeout_sec=0.1)
    child.kill()
    child.wait()
"""
LAUNCHES = {
    "test_with_unittest.py": """
import sys, unittest
import launch, launch_testing, launch_testing.actions, pytest
from launch.actions import ExecuteProcess

@pytest.mark.launch_test
def generate_test_description():
    program = ExecuteProcess(cmd=[sys.executable, "-c", "print('one')"])
    return launch.LaunchDescription([program, launch_testing.actions.ReadyToTest()]), {"program": program}

class TestProgram(unittest.TestCase):
    def test_prints(self, proc_output, program):
        proc_output.assertWaitFor("one", process=program, timeout=240, stream="stdout")
""",
    "test_with_pytest.py": """
import sys
import launch, launch_pytest, pytest
from launch.actions import ExecuteProcess
from launch_pytest.tools import process

PROGRAM = ExecuteProcess(cmd=[sys.executable, "-c", "print('two')"], cached_output=True)

@launch_pytest.fixture
def description():
    return launch.LaunchDescription([PROGRAM, launch_pytest.actions.ReadyToTest()])

@pytest.mark.launch(fixture=description)
async def test_prints(launch_context):
    assert await process.wait_for_output(launch_context, PROGRAM, lambda text: "two" in text, timeout=240)
""",
    "test_unrelated.py": "def test_addition():\n    assert 1 + 1 == 2\n",
}


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_home(tmp_path_factory.mktemp("home"))


def start(
    words: tuple[str, ...], folder: Path, env: Mapping[str, str], *, autoload: bool = False
) -> subprocess.Popen[str]:
    line = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *words]
    if not autoload:  # the plug-ins of the tests' own environment take a second to import
        env = {**env, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    return subprocess.Popen(line, cwd=folder, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize(
    ("plugin", "code"),
    [pytest.param(PLUGIN, 0, marks=pytest.mark.slow), pytest.param((), 1, marks=pytest.mark.soak)],
    ids=["with", "without"],
)
def test_two_test_processes_discover_each_other_only_without_the_plugin(
    plugin: tuple[str, ...], code: int, home: Path, tmp_path: Path
) -> None:
    (tmp_path / "test_meets.py").write_text(MEETS)
    (tmp_path / "place").mkdir()
    env = {**set_up(home), "PLACE": str(tmp_path / "place"), "BOT_CONSOLE_SOCKET_DIR": str(home / "sockets")}
    (home / "sockets").mkdir(mode=0o700, exist_ok=True)
    both = [start(plugin, tmp_path, env) for _ in range(2)]
    outputs = [each.communicate(timeout=240)[0] for each in both]
    assert max(each.returncode for each in both) == code, outputs


def test_tests_run_in_real_and_stepped_time(home: Path, tmp_path: Path) -> None:
    (tmp_path / "test_times.py").write_text(TIMES)
    place = str(tmp_path)
    process = start(PLUGIN, tmp_path, {**set_up(home), "BOT_CONSOLE_SOCKET_DIR": place, "OUTSIDE": place})
    assert "3 passed" in process.communicate(timeout=240)[0]
    process = start((*PLUGIN, "--ros-time", "stepped", "-k", "not child"), tmp_path, set_up(home))
    assert "2 passed" in process.communicate(timeout=240)[0]


@pytest.mark.slow
def test_plain_pytest_runs_launch_tests_in_a_shell_that_was_set_up(home: Path, tmp_path: Path) -> None:
    for name, text in LAUNCHES.items():
        (tmp_path / name).write_text(text)
    process = start(("-p", "no:xdist", "-s", "--launch-args", "a:=b"), tmp_path, set_up(home), autoload=True)
    output = process.communicate(timeout=240)[0]
    assert "3 passed" in output, output


def test_other_tests_load_nothing_of_the_runtime_in_such_a_shell(home: Path, tmp_path: Path) -> None:
    text = "import sys\ndef test_modules():\n    assert 'bot_console.runtime' not in sys.modules\n"
    (tmp_path / "test_modules.py").write_text(text)
    process = start(("-p", "bot_console_launch_tests"), tmp_path, set_up(home))
    assert "1 passed" in process.communicate(timeout=240)[0]


@pytest.mark.slow
def test_pip_does_not_list_the_plugin(home: Path) -> None:
    listed = subprocess.run(
        [sys.executable, "-m", "pip", "freeze"], env=set_up(home), capture_output=True, text=True, check=True
    )
    assert "launch" not in listed.stdout


def beside_a_real_rclpy(home: Path, folder: Path) -> dict[str, str]:
    (folder / "ros" / "rclpy").mkdir(parents=True)
    (folder / "ros" / "rclpy" / "__init__.py").touch()
    env = set_up(home)
    return {**env, "PYTHONPATH": os.pathsep.join([str(folder / "ros"), env["PYTHONPATH"]])}


def test_launch_tests_beside_a_real_rclpy_are_left_to_it(home: Path, tmp_path: Path) -> None:
    asks = "import importlib.metadata as m; print([e.name for e in m.entry_points(group='pytest11')])"
    for env, found in ((set_up(home), True), (beside_a_real_rclpy(home, tmp_path), False)):
        printed = subprocess.run([sys.executable, "-c", asks], env=env, capture_output=True, text=True, check=True)
        assert ("bot_console_launch_tests" in printed.stdout) == found


def test_plugin_is_refused_beside_a_real_rclpy(home: Path, tmp_path: Path) -> None:
    process = start(PLUGIN, tmp_path, beside_a_real_rclpy(home, tmp_path))
    assert "set BOT_CONSOLE_RUNTIME=embedded" in process.communicate(timeout=240)[1]


def workflow(name: str) -> Any:
    """A workflow file of the documentation."""
    text = DOCUMENT.read_text("utf-8").split(f"<!-- workflow: {name} -->\n```yaml\n")[1].split("```")[0]
    return yaml.safe_load(text)


def scripts() -> dict[str, list[str]]:
    """The commands of each workflow, as a list for each shell that it starts."""
    steps = workflow("github")["jobs"]["test"]["steps"]
    return {
        "github": [each["run"] for each in steps if "run" in each],
        "gitlab": ["\n".join(workflow("gitlab")["test"]["script"])],
    }


@pytest.mark.parametrize(
    "name", [pytest.param("github", marks=pytest.mark.slow), pytest.param("gitlab", marks=pytest.mark.soak)]
)
def test_documented_workflow_runs_the_tests(name: str, home: Path, tmp_path: Path) -> None:
    (tmp_path / "test_node.py").write_text("def test_node():\n    import rclpy\n    assert rclpy.ok() is False\n")
    (home / "bin" / "pytest").unlink(missing_ok=True)
    (home / "bin" / "pytest").write_text(f'#!/bin/sh\nexec {sys.executable} -m pytest "$@"\n')
    (home / "bin" / "pytest").chmod(0o755)
    for script in scripts()[name]:
        text, installs = re.subn(r'^pip install "bot-console\[test\]"$', "true", script, flags=re.MULTILINE)
        done = in_shell("bash", home, f"set -e\n{text}", cwd=tmp_path)
        assert done.returncode == 0 and (installs or "1 passed" in done.stdout), done.stdout + done.stderr
    assert (tmp_path / "report.xml").exists()
